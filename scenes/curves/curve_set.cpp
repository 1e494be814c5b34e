#include "scenes/curves/curve_set.h"

#include <algorithm>

#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/text_position.h"

namespace photonproof::inline scenes_curves {
namespace {

class CurveReader {
 public:
  CurveReader(std::string_view text, const std::string& file, std::size_t least)
      : text_(text), file_(file), least_(least) {}

  CurveSet run() {
    for (; next_ < text_.size(); next_ = end_ + 1) {
      end_ = std::min(text_.find('\n', next_), text_.size());
      const std::string_view first = word();
      if (first.empty()) {
        finish();
      } else {
        if (!open_) begin();
        read_point(first);
      }
    }
    finish();
    if (set_.points.empty()) throw InputError(file_, "has no control points, expected at least one curve");
    return std::move(set_);
  }

 private:
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    fail_at_offset(file_, text_, offset, message);
  }

  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  /// The next word of the line, empty at its end.
  std::string_view word() {
    while (next_ < end_ && is_space(text_[next_])) ++next_;
    word_ = next_;
    while (next_ < end_ && !is_space(text_[next_])) ++next_;
    return text_.substr(word_, next_ - word_);
  }

  void begin() {
    open_ = true;
    began_ = word_;
    set_.first.push_back(static_cast<std::uint32_t>(set_.points.size()));
  }

  void finish() {
    if (!open_) return;
    open_ = false;
    const std::size_t count = set_.points.size() - set_.first.back();
    if (count < least_)
      fail(began_, "a curve has " + std::to_string(count) + (count == 1 ? " control point" : " control points") +
                       ", expected at least " + std::to_string(least_));
  }

  float number(std::string_view text) const {
    if (text.empty()) fail(end_, "a control point has too few numbers, expected x y z radius");
    const Parsed<double> parsed = parse_number(text);
    if (!parsed.value) fail(word_, "a control point " + parsed.problem);
    return static_cast<float>(*parsed.value);
  }

  void read_point(std::string_view first) {
    CurvePoint point;
    point.p.x = number(first);
    point.p.y = number(word());
    point.p.z = number(word());
    point.radius = number(word());
    if (point.radius < 0) fail(word_, "a radius is negative");
    if (!word().empty()) fail(word_, "a control point has more than 4 numbers, expected x y z radius");
    set_.points.push_back(point);
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t least_;
  std::size_t next_ = 0, end_ = 0, word_ = 0, began_ = 0;  ///< byte offsets
  bool open_ = false;                                      ///< in a curve
  CurveSet set_;
};

}  // namespace

CurveSet parse_curves(std::string_view text, const std::string& file, std::size_t least) {
  return CurveReader(text, file, least).run();
}

}  // namespace photonproof::inline scenes_curves
