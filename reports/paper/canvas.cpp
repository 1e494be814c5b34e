#include "reports/paper/canvas.h"

#include <cstdlib>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

#ifdef PHOTONPROOF_CAIRO
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <memory>
#endif

namespace photonproof::inline reports_paper {

DrawingKind drawing_kind(const std::filesystem::path& out) {
  const std::string end = out.extension().string();
  if (end == ".svg") return DrawingKind::svg;
  if (end == ".pdf") return DrawingKind::pdf;
  if (end == ".png") return DrawingKind::png;
  throw InputError(out.string(), "a figure is a file .pdf, .svg or .png");
}

#ifndef PHOTONPROOF_CAIRO

bool can_draw() { return false; }

void draw_file(const std::filesystem::path& out, DrawingKind, double, double, const std::string&,
               const std::function<void(Canvas&)>&) {
  throw InputError(out.string(), "drawings need a program that was built with Cairo (Debian: libcairo2-dev)");
}

#else

namespace {

constexpr double pixels_an_inch = 300, points_an_inch = 72;

class CairoCanvas : public Canvas {
 public:
  explicit CairoCanvas(cairo_t* cairo) : cairo_(cairo) {}

  void polyline(const Corners& corners, const Stroke& stroke) override {
    trace(corners);
    set_color(stroke.color, 1);
    cairo_set_line_width(cairo_, stroke.width);
    cairo_set_dash(cairo_, stroke.dash.data(), static_cast<int>(stroke.dash.size()), 0);
    cairo_stroke(cairo_);
  }

  void polygon(const Corners& corners, std::string_view color, double opacity) override {
    trace(corners);
    cairo_close_path(cairo_);
    set_color(color, opacity);
    cairo_fill(cairo_);
  }

  void disk(double x, double y, double radius, std::string_view color) override {
    cairo_new_path(cairo_);
    cairo_arc(cairo_, x, y, radius, 0, 2 * 3.14159265358979);
    set_color(color, 1);
    cairo_fill(cairo_);
  }

  void text(double x, double y, const std::string& text, const TextStyle& style) override {
    set_font(style);
    set_color(style.color, 1);
    cairo_save(cairo_);
    cairo_translate(cairo_, x, y);
    if (style.upwards) cairo_rotate(cairo_, -3.14159265358979 / 2);
    cairo_move_to(cairo_, -style.align * text_width(text, style), 0);
    cairo_show_text(cairo_, text.c_str());
    cairo_restore(cairo_);
  }

  double text_width(const std::string& text, const TextStyle& style) override {
    set_font(style);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, text.c_str(), &extents);
    return extents.x_advance;
  }

  void picture(double x, double y, double width, double height, const Pixels& pixels) override {
    // Enlarged by whole pixels, since readers of SVG and PDF smooth small pictures.
    const int factor = std::max(1, 240 / std::max(1, std::max(pixels.width, pixels.height)));
    const int columns = pixels.width * factor, rows = pixels.height * factor;
    cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows);
    unsigned char* data = cairo_image_surface_get_data(image);
    if (data == nullptr) return cairo_surface_destroy(image);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image));
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const std::uint8_t* rgb =
            &pixels.rgb[3 * (static_cast<std::size_t>(r / factor) * static_cast<std::size_t>(pixels.width) +
                             static_cast<std::size_t>(c / factor))];
        auto* pixel = reinterpret_cast<std::uint32_t*>(data + static_cast<std::size_t>(r) * stride) + c;
        *pixel = static_cast<std::uint32_t>(rgb[0]) << 16 | static_cast<std::uint32_t>(rgb[1]) << 8 | rgb[2];
      }
    cairo_surface_mark_dirty(image);
    cairo_save(cairo_);
    cairo_translate(cairo_, x, y);
    cairo_scale(cairo_, width / columns, height / rows);
    cairo_set_source_surface(cairo_, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cairo_), CAIRO_FILTER_NEAREST);
    cairo_rectangle(cairo_, 0, 0, columns, rows);
    cairo_fill(cairo_);
    cairo_restore(cairo_);
    cairo_surface_destroy(image);
  }

 private:
  void trace(const Corners& corners) {
    cairo_new_path(cairo_);
    for (const auto& [x, y] : corners) cairo_line_to(cairo_, x, y);
  }
  void set_color(std::string_view color, double opacity) {
    const long rgb = std::strtol(std::string(color).c_str(), nullptr, 16);
    cairo_set_source_rgba(cairo_, static_cast<double>(rgb >> 16 & 255) / 255, static_cast<double>(rgb >> 8 & 255) / 255,
                          static_cast<double>(rgb & 255) / 255, opacity);
  }
  void set_font(const TextStyle& style) {
    cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, style.size);
  }

  cairo_t* cairo_;
};

cairo_surface_t* surface_of(const std::string& file, DrawingKind kind, double width, double height,
                            const std::string& created) {
  if (kind == DrawingKind::svg) return cairo_svg_surface_create(file.c_str(), width, height);
  if (kind == DrawingKind::pdf) {
    cairo_surface_t* surface = cairo_pdf_surface_create(file.c_str(), width, height);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, created.c_str());
    return surface;
  }
  constexpr double scale = pixels_an_inch / points_an_inch;
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width * scale + 0.5),
                                    static_cast<int>(height * scale + 0.5));
}

}  // namespace

bool can_draw() { return true; }

void draw_file(const std::filesystem::path& out, DrawingKind kind, double width, double height,
               const std::string& created, const std::function<void(Canvas&)>& draw) {
  replace_atomically(out, [&](const std::filesystem::path& temporary) {
    const std::string file = temporary.string();
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        surface_of(file, kind, width, height, created), cairo_surface_destroy);
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface.get()), cairo_destroy);
    if (kind == DrawingKind::png)
      cairo_scale(cairo.get(), pixels_an_inch / points_an_inch, pixels_an_inch / points_an_inch);
    cairo_set_source_rgb(cairo.get(), 1, 1, 1);
    cairo_paint(cairo.get());
    CairoCanvas canvas(cairo.get());
    draw(canvas);
    cairo_status_t status = cairo_status(cairo.get());
    cairo_show_page(cairo.get());
    if (kind == DrawingKind::png && status == CAIRO_STATUS_SUCCESS)
      status = cairo_surface_write_to_png(surface.get(), file.c_str());
    cairo_surface_finish(surface.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
    if (status != CAIRO_STATUS_SUCCESS)
      throw InputError(out.string(), std::string("cannot be written: ") + cairo_status_to_string(status));
  });
}

#endif

}  // namespace photonproof::inline reports_paper
