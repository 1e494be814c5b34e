#include "reports/view/console_table.h"

#include <algorithm>

#include "reports/view/text.h"

namespace photonproof::reports::inline reports_view {
namespace {

/// Characters of valid UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

const char* escape_of(Emphasis emphasis) {
  switch (emphasis) {
    case Emphasis::bold:
      return "\033[1m";
    case Emphasis::good:
      return "\033[32m";
    case Emphasis::poor:
      return "\033[31m";
    case Emphasis::quiet:
      return "\033[2m";
    case Emphasis::none:
      break;
  }
  return "";
}

std::string emphasised(const std::string& text, Emphasis emphasis, bool colours) {
  if (!colours || emphasis == Emphasis::none || text.empty()) return text;
  return escape_of(emphasis) + text + "\033[0m";
}

}  // namespace

std::string console_table(const std::vector<std::string>& header, const std::vector<std::vector<ConsoleCell>>& rows,
                          std::size_t left, bool colours) {
  std::vector<std::vector<ConsoleCell>> lines{{}};
  for (const std::string& text : header) lines.front().push_back({text, Emphasis::quiet});
  lines.insert(lines.end(), rows.begin(), rows.end());
  std::vector<std::size_t> widths(header.size(), 0);
  for (std::vector<ConsoleCell>& line : lines)
    for (std::size_t i = 0; i < line.size() && i < widths.size(); ++i) {
      line[i].text = printable(line[i].text);
      widths[i] = std::max(widths[i], width_of(line[i].text));
    }
  std::string out;
  for (const std::vector<ConsoleCell>& line : lines) {
    std::size_t spaces = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string padding(i < widths.size() ? widths[i] - width_of(line[i].text) : 0, ' ');
      if (i > 0) spaces += 2;
      if (i >= left) spaces += padding.size();
      if (!line[i].text.empty()) {
        out += std::string(spaces, ' ') + emphasised(line[i].text, line[i].emphasis, colours);
        spaces = 0;
      }
      if (i < left) spaces += padding.size();
    }
    out += "\n";
  }
  return out;
}

}  // namespace photonproof::reports::inline reports_view
