#include "reports/paper/inset_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/paper/paper_words.h"
#include "reports/record/heatmap_magma.h"
#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/results_file.h"
#include "reports/view/verdicts.h"
#include "scenes/base/input_error.h"
#include "scenes/base/srgb.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline reports_paper {
using namespace reports;

namespace {

constexpr double relmse_epsilon = 0.01;  // as the metric relmse

Image read_inside(const std::filesystem::path& folder, const std::string& relative, const std::string& whose) {
  const ResultsFile file = results_file(folder, relative);
  if (file.path.empty()) throw InputError(whose, relative.empty() ? "the record has no image of it" : file.problem);
  return read_image(file.path.string());
}

void check_insets(const std::vector<Inset>& insets, const Image& image) {
  for (const Inset& inset : insets) {
    const bool inside = inset.x >= 0 && inset.y >= 0 && inset.width > 0 && inset.height > 0 &&
                        inset.width <= image.width - inset.x && inset.height <= image.height - inset.y;
    if (!inside)
      throw InputError("--inset", fmt::format("{} {} {} {} is not inside the image of {}x{} pixels", inset.x, inset.y,
                                              inset.width, inset.height, image.width, image.height));
  }
}

double squared_error(const float* test, const float* reference) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double r = reference[c], difference = test[c] - r;
    sum += difference * difference / (r * r + relmse_epsilon);
  }
  return sum / 3;
}

/// Calls `color(pixel's place)` for each pixel of the crop, and keeps its three bytes.
template <class Color>
Pixels pixels_of(const Inset& inset, Color color) {
  Pixels pixels{inset.width, inset.height, {}};
  for (int y = inset.y; y < inset.y + inset.height; ++y)
    for (int x = inset.x; x < inset.x + inset.width; ++x)
      for (const std::uint8_t byte : color(x, y)) pixels.rgb.push_back(byte);
  return pixels;
}

}  // namespace

double crop_relmse(const Image& image, const Image& reference, const Inset& inset) {
  double sum = 0;
  for (int y = inset.y; y < inset.y + inset.height; ++y)
    for (int x = inset.x; x < inset.x + inset.width; ++x)
      sum += squared_error(image.pixel(x, y), reference.pixel(x, y));
  return sum / (static_cast<double>(inset.width) * inset.height);
}

Pixels crop_pixels(const Image& image, const Inset& inset, double exposure) {
  const double scale = std::exp2(exposure);
  return pixels_of(inset, [&](int x, int y) {
    std::array<std::uint8_t, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = std::clamp(scale * image.pixel(x, y)[c], 0.0, 1.0);
      rgb[c] = static_cast<std::uint8_t>(std::lround(255 * encode_srgb(v)));
    }
    return rgb;
  });
}

Pixels error_pixels(const Image& image, const Image& reference, const Inset& inset) {
  return pixels_of(inset, [&](int x, int y) {
    const double error = squared_error(image.pixel(x, y), reference.pixel(x, y));
    const double place = std::clamp((std::log10(std::max(error, 1e-12)) + 4) / 4, 0.0, 1.0);
    const std::uint32_t color = magma_colours[static_cast<std::size_t>(std::lround(255 * place))];
    return std::array{static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8 & 255),
                      static_cast<std::uint8_t>(color & 255)};
  });
}

std::vector<FigureColumn> figure_columns(const View& view, const SceneView& scene, const std::filesystem::path& folder,
                                         const std::vector<Inset>& insets) {
  if (!has_reference(scene)) throw InputError(scene.record.name, "has no reference, so a figure has no last column");
  FigureColumn last{"Reference", reference_text(scene), "",
                    read_inside(folder, reference_image(scene), "the reference of " + scene.record.name)};
  check_insets(insets, last.image);
  std::vector<FigureColumn> columns;
  for (const EngineOutcome& outcome : scene.engines) {
    if (!outcome.shown) continue;
    const Result& shown = *outcome.shown;
    const std::string label = shown.cell.label();
    FigureColumn column{
        method_title(view, shown.cell.engine),
        budget_text(shown.cell.budget) + ", " + or_dash(shown.wall_seconds, [](double v) { return significant(v); }) +
            " s wall",
        "relMSE " + or_dash(metric(shown, "relmse"), [](double v) { return significant(v); }) + doubt_mark(scene),
        read_inside(folder, shown.image, label)};
    if (!shown.image_checksum.empty() && file_checksum(folder / shown.image) != shown.image_checksum)
      throw InputError(label, "its image " + shown.image + " is not the one that was measured");
    if (column.image.width != last.image.width || column.image.height != last.image.height)
      throw InputError(label, "has another size than the reference");
    for (const Inset& inset : insets) column.crop_relmse.push_back(crop_relmse(column.image, last.image, inset));
    columns.push_back(std::move(column));
  }
  if (columns.empty()) throw InputError(scene.record.name, "has no finished image");
  columns.push_back(std::move(last));
  return columns;
}

}  // namespace photonproof::inline reports_paper
