// Draws a page of text, lines and pictures into an SVG, PDF or PNG file, by Cairo. Texts of SVG are outlines and fonts
// of PDF are embedded, so that no reader needs a font. Lengths are in points (1/72 inch); y points down.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace photonproof::inline reports_paper {

enum class DrawingKind { svg, pdf, png };

/// The kind by the end of the name. Throws InputError on any other than .svg, .pdf and .png.
DrawingKind drawing_kind(const std::filesystem::path& out);

struct Stroke {
  std::string color = "000000";  ///< "RRGGBB"
  double width = 0.6;
  std::vector<double> dash{};
};

struct TextStyle {
  double size = 7.5;
  double align = 0;  ///< 0 begins at the place, 0.5 is centred, 1 ends there
  bool bold = false;
  bool upwards = false;  ///< turned by 90 degrees
  std::string color = "000000";
};

/// 8-bit sRGB, row 0 on top.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

using Corners = std::vector<std::array<double, 2>>;

class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void polyline(const Corners& corners, const Stroke& stroke) = 0;
  /// A filled polygon.
  virtual void polygon(const Corners& corners, std::string_view color, double opacity) = 0;
  virtual void disk(double x, double y, double radius, std::string_view color) = 0;
  /// The base line begins, is centred or ends at (x, y).
  virtual void text(double x, double y, const std::string& text, const TextStyle& style) = 0;
  virtual double text_width(const std::string& text, const TextStyle& style) = 0;
  /// Pixels stay sharp squares.
  virtual void picture(double x, double y, double width, double height, const Pixels& pixels) = 0;
};

/// Writes the file as a whole; PNG has 300 pixels an inch. `created` is the date in the file, ISO 8601. Throws
/// InputError if the file cannot be written, or if the program is built without Cairo.
void draw_file(const std::filesystem::path& out, DrawingKind kind, double width, double height,
               const std::string& created, const std::function<void(Canvas&)>& draw);

/// Whether the program is built with Cairo.
bool can_draw();

}  // namespace photonproof::inline reports_paper
