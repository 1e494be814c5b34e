#include "reference/sdl_text.h"

#include <cstdio>

#include "scenes/text_numbers.h"

namespace photonproof {

std::string sdl_vector(const Vec3d& v) {
  return "<" + format_number(v.x) + "," + format_number(v.y) + "," + format_number(v.z) + ">";
}

std::string sdl_rgb(const RgbD& colour) {
  const bool grey = colour.x == colour.y && colour.y == colour.z;
  return "rgb " + (grey ? format_number(colour.x) : sdl_vector(colour));
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string printable(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (c < 0x20 || c > 0x7e) c = '?';
  return line;
}

void SdlWriter::explain(std::string_view text) {
  explanations_.push_back(printable(text));
  text_ += "// " + explanations_.back() + "\n";
}

void SdlWriter::line(std::string_view sdl) {
  text_ += sdl;
  text_ += '\n';
}

}  // namespace photonproof
