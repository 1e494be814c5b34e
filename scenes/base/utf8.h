// UTF-8 checks for untrusted text that ends up in messages and JSON.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_base {

/// The offset of the first byte that is not part of a well-formed UTF-8 sequence (Unicode 15, table 3-7), or npos.
std::size_t find_invalid_utf8(std::string_view text);

/// True for the bytes below 32 except tab, line feed and carriage return.
inline bool is_control_character(char c) {
  return static_cast<unsigned char>(c) < 32 && c != '\t' && c != '\n' && c != '\r';
}

/// Text of other programs, files or command lines made safe for a terminal, JSON, HTML or XML: valid UTF-8 on one line.
/// A control character (line breaks, tabs and those of C1 among them) becomes `for_controls`. A malformed byte or a
/// character that changes the writing direction becomes `for_others`.
std::string harmless(std::string_view text, std::string_view for_controls, std::string_view for_others);

/// The same for messages: '?' in place of each, and tabs stay.
std::string printable(std::string_view text);

}  // namespace photonproof::inline scenes_base
