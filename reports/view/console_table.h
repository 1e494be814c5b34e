// A table for a terminal: aligned columns under heads, with emphasis where the terminal shows it.
#pragma once

#include <string>
#include <vector>

namespace photonproof::reports::inline reports_view {

enum class Emphasis { none, bold, good, poor, quiet };

struct ConsoleCell {
  std::string text;
  Emphasis emphasis = Emphasis::none;
};

/// Two spaces apart; the first `left` columns are text, the others are right-aligned. Widths count characters. Without
/// `colours` no escape sequence is written. Trailing spaces are left out.
std::string console_table(const std::vector<std::string>& header, const std::vector<std::vector<ConsoleCell>>& rows,
                          std::size_t left, bool colours);

}  // namespace photonproof::reports::inline reports_view
