#include "reports/view/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "scenes/base/utf8.h"

namespace photonproof::reports::inline reports_view {

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

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // a continuation byte
  return text.substr(0, end);
}

namespace {

/// The exponent at the start of `rest` as digits, and the number of its bytes: numbers.h writes 10⁻³.
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

/// Length in bytes of the character of valid UTF-8 that starts with this byte.
std::size_t utf8_length(char first) {
  const auto lead = static_cast<unsigned char>(first);
  return lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
}

struct Replacement {
  std::string_view from, to;
};

/// Characters that are special to LaTeX, those that reports write, and letters of Western European names. Plain LaTeX
/// has them all, without a package and in any encoding of the document.
constexpr Replacement latex_replacements[] = {
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
    {"·", "$\\cdot$"},
    {"±", "$\\pm$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"≈", "$\\approx$"},
    {"≠", "$\\neq$"},
    {"√", "$\\surd$"},
    {"∞", "$\\infty$"},
    {"→", "$\\rightarrow$"},
    {"←", "$\\leftarrow$"},
    {"↑", "$\\uparrow$"},
    {"↓", "$\\downarrow$"},
    {"α", "$\\alpha$"},
    {"ρ", "$\\rho$"},
    {"σ", "$\\sigma$"},
    {"χ", "$\\chi$"},
    {"µ", "$\\mu$"},
    {"°", "$^{\\circ}$"},
    {"†", "$\\dagger$"},
    {"–", "--"},
    {"—", "---"},
    {"…", "\\ldots{}"},
    {"’", "'"},
    {"‘", "`"},
    {"“", "``"},
    {"”", "''"},
    {"\u202F", "\\,"},
    {"\u00A0", "~"},
    {"À", "\\`{A}"},
    {"Á", "\\'{A}"},
    {"Â", "\\^{A}"},
    {"Ã", "\\~{A}"},
    {"Ä", "\\\"{A}"},
    {"Å", "\\r{A}"},
    {"Æ", "\\AE{}"},
    {"Ç", "\\c{C}"},
    {"È", "\\`{E}"},
    {"É", "\\'{E}"},
    {"Ê", "\\^{E}"},
    {"Ë", "\\\"{E}"},
    {"Ì", "\\`{I}"},
    {"Í", "\\'{I}"},
    {"Î", "\\^{I}"},
    {"Ï", "\\\"{I}"},
    {"Ñ", "\\~{N}"},
    {"Ò", "\\`{O}"},
    {"Ó", "\\'{O}"},
    {"Ô", "\\^{O}"},
    {"Õ", "\\~{O}"},
    {"Ö", "\\\"{O}"},
    {"Ø", "\\O{}"},
    {"Ù", "\\`{U}"},
    {"Ú", "\\'{U}"},
    {"Û", "\\^{U}"},
    {"Ü", "\\\"{U}"},
    {"Ý", "\\'{Y}"},
    {"ß", "\\ss{}"},
    {"à", "\\`{a}"},
    {"á", "\\'{a}"},
    {"â", "\\^{a}"},
    {"ã", "\\~{a}"},
    {"ä", "\\\"{a}"},
    {"å", "\\r{a}"},
    {"æ", "\\ae{}"},
    {"ç", "\\c{c}"},
    {"è", "\\`{e}"},
    {"é", "\\'{e}"},
    {"ê", "\\^{e}"},
    {"ë", "\\\"{e}"},
    {"ì", "\\`{\\i{}}"},
    {"í", "\\'{\\i{}}"},
    {"î", "\\^{\\i{}}"},
    {"ï", "\\\"{\\i{}}"},
    {"ñ", "\\~{n}"},
    {"ò", "\\`{o}"},
    {"ó", "\\'{o}"},
    {"ô", "\\^{o}"},
    {"õ", "\\~{o}"},
    {"ö", "\\\"{o}"},
    {"ø", "\\o{}"},
    {"ù", "\\`{u}"},
    {"ú", "\\'{u}"},
    {"û", "\\^{u}"},
    {"ü", "\\\"{u}"},
    {"ý", "\\'{y}"},
    {"ÿ", "\\\"{y}"},
};

}  // namespace

std::string latex_text(std::string_view text) {
  const std::string safe = printable(text);
  std::string out;
  for (std::size_t at = 0; at < safe.size();) {
    const std::string_view rest = std::string_view(safe).substr(at);
    if (const auto [digits, bytes] = leading_exponent(rest); bytes > 0) {
      out += "$^{" + digits + "}$";
      at += bytes;
      continue;
    }
    const std::string_view character = rest.substr(0, utf8_length(rest.front()));
    const auto found = std::ranges::find(latex_replacements, character, &Replacement::from);
    out += found != std::end(latex_replacements) ? std::string(found->to) : ascii_text(character);
    at += character.size();
  }
  return out;
}

std::string ascii_text(std::string_view text) {
  const std::string safe = printable(text);
  std::string out;
  for (std::size_t at = 0; at < safe.size();) {
    const std::size_t length = utf8_length(safe[at]);
    const auto lead = static_cast<unsigned char>(safe[at]);
    if (length == 1) {
      out += safe[at];
    } else {
      std::uint32_t code = lead & (0xFFu >> (length + 1));
      for (std::size_t i = 1; i < length; ++i) code = code << 6 | (static_cast<unsigned char>(safe[at + i]) & 0x3Fu);
      out += fmt::format("[U+{:04X}]", code);
    }
    at += length;
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

}  // namespace photonproof::reports::inline reports_view
