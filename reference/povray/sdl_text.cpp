#include "reference/povray/sdl_text.h"

#include <cstdio>
#include <sstream>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline reference_povray {

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

std::string ascii_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (c < 0x20 || c > 0x7e) c = '?';
  return line;
}

void SdlText::append(std::string_view text) {
  if (parts_.empty() || !std::holds_alternative<std::string>(parts_.back())) parts_.emplace_back(std::string());
  std::get<std::string>(parts_.back()) += text;
}

void SdlText::write(std::ostream& out) const {
  for (const auto& part : parts_) {
    if (const auto* text = std::get_if<std::string>(&part))
      out << *text;
    else
      std::get<std::function<void(std::ostream&)>>(part)(out);
  }
}

std::string SdlText::str() const {
  std::ostringstream out;
  write(out);
  return out.str();
}

void SdlWriter::explain(std::string_view text) {
  explanations_.push_back(ascii_line(text));
  line("// " + explanations_.back());
}

void SdlWriter::line(std::string_view sdl) {
  text_.append(sdl);
  text_.append("\n");
}

}  // namespace photonproof::inline reference_povray
