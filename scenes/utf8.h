// UTF-8 checks for untrusted text that ends up in messages and JSON.
#pragma once

#include <string>
#include <string_view>

namespace photonproof {

/// The offset of the first byte that is not part of a well-formed UTF-8 sequence (Unicode 15, table 3-7), or npos.
std::size_t find_invalid_utf8(std::string_view text);

/// True for the bytes below 32 but for tab, line feed and carriage return.
inline bool is_control_character(char c) {
  return static_cast<unsigned char>(c) < 32 && c != '\t' && c != '\n' && c != '\r';
}

/// The text on one line: what would break it or a JSON record (control characters but tab, invalid UTF-8) becomes '?'.
std::string printable(std::string text);

}  // namespace photonproof
