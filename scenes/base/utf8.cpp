#include "scenes/base/utf8.h"

#include <algorithm>
#include <cstdint>

namespace photonproof::inline scenes_base {
namespace {

struct CodePoint {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< 0: malformed
};

/// The code point at the start of `text`, which is not empty, as Unicode 15 table 3-7 allows it: no overlong forms, no
/// surrogates, nothing past U+10FFFF.
CodePoint decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = (code << 6) | (byte(i) & 0x3F);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < smallest[length] || surrogate || code > 0x10FFFF) return {};
  return {code, length};
}

/// C0, DEL, C1 (U+009B begins a terminal's command as ESC [ does) and the two separators of lines.
bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

/// Embeddings, overrides and isolates: they can make a line read as something it is not.
bool is_bidirectional_control(std::uint32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

/// XML refuses them in any form, even escaped.
bool is_no_character(std::uint32_t code) { return code == 0xFFFE || code == 0xFFFF; }

}  // namespace

std::size_t find_invalid_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = decode(text.substr(at)).length;
    if (length == 0) return at;
    at += length;
  }
  return std::string_view::npos;
}

std::string harmless(std::string_view text, std::string_view for_controls, std::string_view for_others) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const CodePoint point = decode(text);
    if (point.length == 0 || is_bidirectional_control(point.code) || is_no_character(point.code))
      out += for_others;
    else if (is_control(point.code))
      out += for_controls;
    else
      out += text.substr(0, point.length);
    text.remove_prefix(std::max<std::size_t>(point.length, 1));
  }
  return out;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t tab = text.find('\t'); tab != std::string_view::npos; tab = text.find('\t')) {
    out += harmless(text.substr(0, tab), "?", "?") + '\t';
    text.remove_prefix(tab + 1);
  }
  return out + harmless(text, "?", "?");
}

}  // namespace photonproof::inline scenes_base
