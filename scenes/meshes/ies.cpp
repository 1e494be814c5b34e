#include "scenes/meshes/ies.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scenes/base/text_numbers.h"
#include "scenes/base/text_position.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_meshes {
namespace {

constexpr std::int64_t kMaxAngles = 10'000;

class IesReader {
 public:
  IesReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  IesProfile run() {
    skip_keywords();
    read_scale();
    const auto rows = static_cast<std::size_t>(vertical_), columns = static_cast<std::size_t>(horizontal_);
    if (rows * columns > (text_.size() - next_ + 1) / 2)  // a digit and white space each
      fail(text_.size(),
           "the file ends within the candela values, of which " + std::to_string(rows * columns) + " were promised");
    read_angles(profile_.vertical_degrees, rows);
    check_vertical();
    read_angles(profile_.horizontal_degrees, columns);
    check_horizontal();
    profile_.candela.reserve(rows * columns);
    for (std::size_t i = 0; i < rows * columns; ++i) {
      const double candela = number("a candela value") * scale_;
      if (!(candela >= 0 && candela <= kLargest)) fail(last_, "the candela value is negative or out of range");
      profile_.candela.push_back(candela);
    }
    if (const std::size_t more = text_.find_first_not_of(kSpace, next_); more < text_.find('\0', next_))
      fail(more, "unexpected text after the last candela value, expected the end of the file");
    return std::move(profile_);
  }

 private:
  static constexpr std::string_view kSpace = " \t\r\n,\x1A";  // some files end with DOS's end-of-file character
  static constexpr double kLargest = 1e30;                    // stays a float after all multiplications

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    fail_at_offset(file_, text_, offset, message);
  }

  /// Everything up to TILT=NONE.
  void skip_keywords() {
    const std::size_t tilt = text_.find("TILT=");
    if (tilt == std::string_view::npos) fail(0, "no line TILT= found, expected an IES LM-63 file");
    const std::size_t value = tilt + 5;
    next_ = std::min(text_.find_first_of("\r\n", value), text_.size());
    std::string_view word = text_.substr(value, next_ - value);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) word.remove_suffix(1);
    while (!word.empty() && (word.front() == ' ' || word.front() == '\t')) word.remove_prefix(1);
    if (word != "NONE") fail(tilt, "TILT is " + in_quotes(word) + ", expected NONE");
  }

  void read_scale() {
    whole("the number of lights", 0, 1'000'000);
    number("the lumens per light");
    const double multiplier = number("the candela multiplier");
    if (!(multiplier > 0))
      fail(last_, "the candela multiplier is " + format_number(multiplier) + ", expected more than 0");
    vertical_ = whole("the number of vertical angles", 2, kMaxAngles);
    horizontal_ = whole("the number of horizontal angles", 1, kMaxAngles);
    if (const auto type = whole("the photometric type", 1, 3); type != 1)
      fail(last_, "the photometric type is " + std::to_string(type) + ", expected 1 (type C)");
    whole("the units", 1, 2);
    for (const char* size : {"the width", "the length", "the height"}) number(size);
    const double ballast = positive("the ballast factor"), light = positive("the ballast-light factor");
    number("the input watts");
    scale_ = multiplier * ballast * light;
  }

  void read_angles(std::vector<double>& angles, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = number("an angle");
      if (!(angle >= 0 && angle <= 360) || (i > 0 && angle <= angles.back()))
        fail(last_, "the angle " + format_number(angle) + " does not ascend from 0 to 360");
      angles.push_back(angle);
    }
  }

  void check_vertical() const {
    const double first = profile_.vertical_degrees.front(), last = profile_.vertical_degrees.back();
    if ((first != 0 && first != 90) || (last != 90 && last != 180))
      fail(last_, "the vertical angles go from " + format_number(first) + " to " + format_number(last) +
                      ", expected 0 or 90 to 90 or 180");
  }

  void check_horizontal() const {
    const double first = profile_.horizontal_degrees.front(), last = profile_.horizontal_degrees.back();
    if (first != 0 || (last != 0 && last != 90 && last != 180 && last != 360))
      fail(last_, "the horizontal angles go from " + format_number(first) + " to " + format_number(last) +
                      ", expected 0 to 0, 90, 180 or 360");
  }

  double positive(const char* what) {
    const double value = number(what);
    if (!(value > 0)) fail(last_, std::string(what) + " is " + format_number(value) + ", expected more than 0");
    return value;
  }

  std::int64_t whole(const char* what, std::int64_t low, std::int64_t high) {
    const double value = number(what);
    if (value != std::floor(value) || value < static_cast<double>(low) || value > static_cast<double>(high))
      fail(last_, std::string(what) + " is " + format_number(value) + ", expected a whole number from " +
                      std::to_string(low) + " to " + std::to_string(high));
    return static_cast<std::int64_t>(value);
  }

  double number(const char* what) {
    const std::size_t begin = text_.find_first_not_of(kSpace, next_);
    if (begin == std::string_view::npos) fail(text_.size(), std::string("the file ends before ") + what);
    next_ = std::min(text_.find_first_of(kSpace, begin), text_.size());
    last_ = begin;
    const auto parsed = parse_number(text_.substr(begin, next_ - begin));
    if (!parsed.value) fail(begin, std::string(what) + " " + parsed.problem);
    return *parsed.value;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t next_ = 0;
  std::size_t last_ = 0;  // where the last number starts
  std::int64_t vertical_ = 0, horizontal_ = 0;
  double scale_ = 1;
  IesProfile profile_;
};

}  // namespace

IesProfile read_ies(const std::string& path) { return parse_ies(read_file(path, kMaxIesBytes), path); }

IesProfile parse_ies(std::string_view text, const std::string& file) { return IesReader(text, file).run(); }

}  // namespace photonproof::inline scenes_meshes
