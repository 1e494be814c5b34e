// Numbers as scene files spell them: decimal, locale-independent, whole text or nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace photonproof::inline scenes_base {

/// A value, or a problem in words ("is 'x', which is not a number") when there is none.
template <class T>
struct Parsed {
  std::optional<T> value;
  std::string problem;
};

/// A finite decimal number with optional sign, exponent and surrounding white space; no hexadecimal, inf or nan. It
/// must fit a float, since the renderer computes in float.
Parsed<double> parse_number(std::string_view text);

/// A decimal integer of 64 bits with optional sign and surrounding white space.
Parsed<std::int64_t> parse_integer(std::string_view text);

/// The shortest decimal text that parse_number reads back as the same bits.
std::string format_number(double value);

/// Parts between white space and commas, Mitsuba's list syntax; empty parts are dropped.
std::vector<std::string_view> split_list(std::string_view text);

/// `text` for a message: at most 60 bytes, quoted and printable.
std::string in_quotes(std::string_view text);

}  // namespace photonproof::inline scenes_base
