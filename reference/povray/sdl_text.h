// Writes numbers, vectors and comments of POV-Ray's scene description language. No text of a scene file can leave a
// comment.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline reference_povray {

/// "<x,y,z>", each number the shortest text that reads back as the same double.
std::string sdl_vector(const Vec3d& v);
/// "rgb <r,g,b>", or "rgb v" for a grey.
std::string sdl_rgb(const RgbD& colour);
/// A figure for people, four significant digits.
std::string rounded(double value);
/// `text` as one line of printable ASCII: control and other bytes become '?'.
std::string ascii_line(std::string_view text);

/// A text in parts. Parts too long to keep are made only when they are written.
class SdlText {
 public:
  void append(std::string_view text);
  void append(std::function<void(std::ostream&)> part) { parts_.emplace_back(std::move(part)); }
  void write(std::ostream& out) const;
  std::string str() const;

 private:
  std::vector<std::variant<std::string, std::function<void(std::ostream&)>>> parts_;
};

class SdlWriter {
 public:
  /// A comment line that is also kept as an explanation of the conversion.
  void explain(std::string_view text);
  void line(std::string_view sdl);
  /// Whole lines that `part` writes each time the text is written; `part` must own all it uses.
  void later(std::function<void(std::ostream&)> part) { text_.append(std::move(part)); }
  const SdlText& text() const { return text_; }
  const std::vector<std::string>& explanations() const { return explanations_; }

 private:
  SdlText text_;
  std::vector<std::string> explanations_;
};

}  // namespace photonproof::inline reference_povray
