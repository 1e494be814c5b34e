// Writing POV-Ray's scene description language: numbers, vectors and comments, with nothing a scene file says able to
// leave a comment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/vec.h"

namespace photonproof {

/// "<x,y,z>", each number the shortest text that reads back as the same double.
std::string sdl_vector(const Vec3d& v);
/// "rgb <r,g,b>", or "rgb v" for a grey.
std::string sdl_rgb(const RgbD& colour);
/// A figure for people, four significant digits.
std::string rounded(double value);
/// `text` as one line of printable ASCII: control and other bytes become '?'.
std::string printable(std::string_view text);

class SdlWriter {
 public:
  /// A comment line that is also kept as an explanation of the conversion.
  void explain(std::string_view text);
  void line(std::string_view sdl);
  const std::string& text() const { return text_; }
  const std::vector<std::string>& explanations() const { return explanations_; }

 private:
  std::string text_;
  std::vector<std::string> explanations_;
};

}  // namespace photonproof
