#include "scenes/base/text_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_base {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// The text without surrounding white space and an explicit plus, which std::from_chars rejects.
std::string_view bare(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return text;
}

bool starts_like_a_number(std::string_view text) {
  if (!text.empty() && text[0] == '-') text.remove_prefix(1);
  return !text.empty() && ((text[0] >= '0' && text[0] <= '9') || text[0] == '.');
}

}  // namespace

Parsed<double> parse_number(std::string_view text) {
  const std::string_view digits = bare(text);
  if (digits.empty()) return {std::nullopt, "is empty, expected a number"};
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (!starts_like_a_number(digits) || error == std::errc::invalid_argument || !whole)
    return {std::nullopt, "is " + in_quotes(text) + ", which is not a finite decimal number"};
  if (error == std::errc::result_out_of_range || std::abs(value) > double{std::numeric_limits<float>::max()})
    return {std::nullopt, "is " + in_quotes(text) + ", which is out of range, expected a magnitude of at most 3.4e38"};
  return {value, {}};
}

Parsed<std::int64_t> parse_integer(std::string_view text) {
  const std::string_view digits = bare(text);
  if (digits.empty()) return {std::nullopt, "is empty, expected an integer"};
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    return {std::nullopt, "is " + in_quotes(text) + ", which is not a decimal integer"};
  if (error == std::errc::result_out_of_range)
    return {std::nullopt, "is " + in_quotes(text) + ", which does not fit 64 bits"};
  return {value, {}};
}

std::string format_number(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::vector<std::string_view> split_list(std::string_view text) {
  constexpr std::string_view kSeparators = " \t\r\n,";
  std::vector<std::string_view> parts;
  for (auto begin = text.find_first_not_of(kSeparators); begin != std::string_view::npos;) {
    const auto end = std::min(text.find_first_of(kSeparators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kSeparators, end);
  }
  return parts;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return "'" + printable(std::string(text)) + "'";
  std::string_view start = text.substr(0, kLongest);
  // The cut may have left a part of a character behind, of at most three bytes.
  if (const auto bad = find_invalid_utf8(start); bad != std::string_view::npos && bad + 3 >= kLongest)
    start = start.substr(0, bad);
  return "'" + printable(std::string(start)) + "...'";
}

}  // namespace photonproof::inline scenes_base
