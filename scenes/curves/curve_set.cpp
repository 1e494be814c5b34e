#include "scenes/curves/curve_set.h"

#include "scenes/base/input_error.h"
#include "scenes/base/line_words.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_curves {
namespace {

class CurveReader : LineWords {
 public:
  CurveReader(std::string_view text, const std::string& file, std::size_t least)
      : LineWords(text, file), least_(least) {}

  CurveSet run() {
    for (; begin_line(); skip_line()) {
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

  std::size_t least_;
  std::size_t began_ = 0;  ///< where the curve does
  bool open_ = false;      ///< in a curve
  CurveSet set_;
};

}  // namespace

CurveSet parse_curves(std::string_view text, const std::string& file, std::size_t least) {
  return CurveReader(text, file, least).run();
}

}  // namespace photonproof::inline scenes_curves
