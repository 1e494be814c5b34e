// Lays out the figure of crops: the reference with the crops' frames on the left, a column for each engine and the
// reference last. Below each crop is its error in false colour.
#include <algorithm>
#include <cmath>

#include "reports/paper/canvas.h"
#include "reports/paper/inset_figure.h"
#include "reports/paper/paper_formats.h"
#include "reports/paper/paper_words.h"
#include "reports/record/heatmap_magma.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_paper {
using namespace reports;

namespace {

constexpr double figure_width = 496;  // the width of the text of two columns
constexpr double overview_width = 118, gap = 4, widest_column = 90, head_height = 30, number_height = 10;
constexpr const char* frame_colors[] = {"D55E00", "0072B2", "009E73", "CC79A7", "E69F00"};

const char* frame_color(std::size_t inset) { return frame_colors[inset % std::size(frame_colors)]; }

Corners rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}};
}

struct Layout {
  double left = 0;  ///< of the first column
  double cell = 0;  ///< width of a column
  double step() const { return cell + gap; }
};

double row_height(const Inset& inset, double cell) { return cell * inset.height / inset.width; }

/// The largest size, up to the usual one, at which the text is not wider than `most`.
double fitting_size(Canvas& canvas, const std::string& text, TextStyle style, double most) {
  const double width = canvas.text_width(text, style);
  return width > most ? style.size * most / width : style.size;
}

void fitted_text(Canvas& canvas, double x, double y, const std::string& raw, TextStyle style, double most) {
  const std::string text = printable(raw);
  style.size = fitting_size(canvas, text, style, most);
  canvas.text(x, y, text, style);
}

void draw_overview(Canvas& canvas, const Image& reference, const std::vector<Inset>& insets, double exposure,
                   const std::string& title) {
  const double scale = overview_width / reference.width, top = head_height;
  fitted_text(canvas, overview_width / 2, 9, title, {.size = 8.5, .align = 0.5, .bold = true}, overview_width);
  canvas.picture(0, top, overview_width, scale * reference.height,
                 crop_pixels(reference, {0, 0, reference.width, reference.height}, exposure));
  for (std::size_t i = 0; i < insets.size(); ++i) {
    const Inset& inset = insets[i];
    const Corners corners =
        rectangle(scale * inset.x, top + scale * inset.y, scale * inset.width, scale * inset.height);
    canvas.polyline(corners, {"FFFFFF", 2.2, {}});
    canvas.polyline(corners, {frame_color(i), 1.2, {}});
  }
}

/// The colours of the errors with their numbers, in the cell of the reference.
void draw_scale(Canvas& canvas, double x, double y, double cell, double height) {
  const double bar = std::min(height - 14, 60.0), top = y + (height - bar) / 2;
  Pixels pixels{1, 256, {}};
  for (int i = 255; i >= 0; --i)
    for (const int shift : {16, 8, 0})
      pixels.rgb.push_back(static_cast<std::uint8_t>(magma_colours[static_cast<std::size_t>(i)] >> shift & 255));
  canvas.picture(x + cell / 2 - 16, top, 7, bar, pixels);
  canvas.text(x + cell / 2 - 6, top + 5, "1", {.size = 6});
  canvas.text(x + cell / 2 - 6, top + bar / 2 + 2, "0.01", {.size = 6});
  canvas.text(x + cell / 2 - 6, top + bar, "0.0001", {.size = 6});
  canvas.text(x + cell / 2, top - 3, "relative error²", {.size = 6, .align = 0.5});
}

void draw_column(Canvas& canvas, const FigureColumn& column, const FigureColumn& reference,
                 const std::vector<Inset>& insets, double x, double cell, double exposure) {
  const bool is_reference = &column == &reference;
  const double middle = x + cell / 2;
  fitted_text(canvas, middle, 9, column.title, {.size = 8, .align = 0.5, .bold = true}, cell);
  fitted_text(canvas, middle, 18, column.budget, {.size = 6.5, .align = 0.5}, cell);
  fitted_text(canvas, middle, 26, column.relmse, {.size = 6.5, .align = 0.5}, cell);
  double y = head_height;
  for (std::size_t i = 0; i < insets.size(); ++i) {
    const double height = row_height(insets[i], cell);
    canvas.picture(x, y, cell, height, crop_pixels(column.image, insets[i], exposure));
    canvas.polyline(rectangle(x, y, cell, height), {frame_color(i), 1.2, {}});
    y += height + gap;
    if (is_reference) {
      if (i == 0) draw_scale(canvas, x, y, cell, height);
    } else {
      canvas.picture(x, y, cell, height, error_pixels(column.image, reference.image, insets[i]));
      canvas.text(middle, y + height + 8, "relMSE " + significant(column.crop_relmse[i]), {.size = 6.5, .align = 0.5});
    }
    y += height + number_height + gap;
  }
}

}  // namespace

void write_inset_figure(const Results& results, const std::filesystem::path& folder, const std::filesystem::path& out,
                        const PaperOptions& options) {
  const DrawingKind kind = drawing_kind(out);
  const View view = arrange(results);
  if (options.scene.empty() && view.scenes.size() != 1)
    throw InputError("--scene", "a figure shows one scene, and the record has " + std::to_string(view.scenes.size()));
  const SceneView& scene = options.scene.empty() ? view.scenes.front() : scene_of(view, options.scene);
  std::vector<FigureColumn> columns = figure_columns(view, scene, folder, options.insets);
  const FigureColumn& reference = columns.back();
  const bool crops = !options.insets.empty();
  const std::vector<Inset> insets =
      crops ? options.insets : std::vector<Inset>{{0, 0, reference.image.width, reference.image.height}};
  if (!crops)
    for (FigureColumn& column : columns) column.crop_relmse = {crop_relmse(column.image, reference.image, insets[0])};

  Layout layout;
  layout.left = crops ? overview_width + 2 * gap : 0;
  const auto count = static_cast<double>(columns.size());
  layout.cell = std::min(widest_column, (figure_width - layout.left - gap * (count - 1)) / count);
  double height = head_height;
  for (const Inset& inset : insets) height += 2 * (row_height(inset, layout.cell) + gap) + number_height;
  if (crops)
    height = std::max(height, head_height + overview_width * reference.image.height / reference.image.width + 1);
  const double width = layout.left + count * layout.step() - gap + 1;
  draw_file(out, kind, width, height, results.created, [&](Canvas& canvas) {
    const double exposure = scene.record.exposure;
    if (crops) draw_overview(canvas, reference.image, insets, exposure, scene_title(scene.record));
    for (std::size_t c = 0; c < columns.size(); ++c)
      draw_column(canvas, columns[c], reference, insets, layout.left + static_cast<double>(c) * layout.step(),
                  layout.cell, exposure);
  });
}

}  // namespace photonproof::inline reports_paper
