#include "reports/view/text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "scenes/text/utf8.h"

namespace photonproof::reports {

std::string printable(std::string_view text) { return harmless(text, " ", "\xEF\xBF\xBD"); }

std::string markdown_text(std::string_view text) {
  constexpr std::string_view markup = "\\`*_[]<>|~&#$!";
  std::string out;
  for (const char c : printable(text)) {
    if (markup.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // a continuation byte
  return text.substr(0, end);
}

namespace {

/// The exponent that `rest` begins with, as digits, and how many bytes it takes: numbers.h writes 10⁻³.
std::pair<std::string, std::size_t> leading_exponent(std::string_view rest) {
  static constexpr std::string_view marks[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹", "⁻"};
  std::string digits;
  std::size_t bytes = 0;
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < std::size(marks); ++i) {
      if (!rest.substr(bytes).starts_with(marks[i])) continue;
      digits += i < 10 ? static_cast<char>('0' + i) : '-';
      bytes += marks[i].size();
      again = true;
      break;
    }
  }
  return {digits, bytes};
}

}  // namespace

std::string latex_text(std::string_view text) {
  struct Replacement {
    std::string_view from, to;
  };
  static constexpr Replacement replacements[] = {
      {"\\", "\\textbackslash{}"},
      {"{", "\\{"},
      {"}", "\\}"},
      {"$", "\\$"},
      {"&", "\\&"},
      {"#", "\\#"},
      {"%", "\\%"},
      {"_", "\\_"},
      {"^", "\\textasciicircum{}"},
      {"~", "\\textasciitilde{}"},
      {"<", "\\textless{}"},
      {">", "\\textgreater{}"},
      {"|", "\\textbar{}"},
      {"\"", "''"},
      {"−", "$-$"},
      {"×", "$\\times$"},
      {"–", "--"},
      {"∞", "$\\infty$"},
      {"\u202F", "\\,"},
      {"±", "$\\pm$"},
      {"α", "$\\alpha$"},
  };
  const std::string safe = printable(text);
  std::string out;
  for (std::size_t at = 0; at < safe.size();) {
    const std::string_view rest = std::string_view(safe).substr(at);
    if (const auto [digits, bytes] = leading_exponent(rest); bytes > 0) {
      out += "$^{" + digits + "}$";
      at += bytes;
      continue;
    }
    const auto found =
        std::ranges::find_if(replacements, [&](const Replacement& r) { return rest.starts_with(r.from); });
    if (found == std::end(replacements)) {
      out += rest.front();
      ++at;
    } else {
      out += found->to;
      at += found->from.size();
    }
  }
  return out;
}

std::string csv_cell(const std::string& text) {
  std::string safe = printable(text);
  if (!safe.empty() && std::string_view("=+-@").find(safe.front()) != std::string_view::npos) safe.insert(0, 1, '\'');
  if (safe.find_first_of(",\"") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (const char c : safe) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string json_in_html(const std::string& json) {
  std::string out;
  for (const char c : json) out += c == '<' ? "\\u003c" : std::string(1, c);
  return out;
}

std::string url_path(std::string_view path) {
  constexpr std::string_view hex = "0123456789ABCDEF";
  constexpr std::string_view kept = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string out;
  for (const char c : path) {
    if (kept.find(c) != std::string_view::npos) {
      out += c;
    } else {
      const auto value = static_cast<unsigned char>(c);
      out += '%';
      out += hex[value >> 4];
      out += hex[value & 15];
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const std::uint32_t group = byte(0) << 16 | byte(1) << 8 | byte(2);
    out += alphabet[group >> 18];
    out += alphabet[group >> 12 & 63];
    out += i + 1 < bytes.size() ? alphabet[group >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? alphabet[group & 63] : '=';
  }
  return out;
}

}  // namespace photonproof::reports
