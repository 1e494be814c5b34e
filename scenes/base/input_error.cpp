#include "scenes/base/input_error.h"

#include <algorithm>

#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_base {
namespace {

std::string one_line(const std::string& file, int line, int column, const std::string& message) {
  return printable(file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": error: " + message);
}

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The source line (of a long one the part around the column) with a caret below `column`, a byte counted from 1.
std::string with_excerpt(const std::string& summary, int column, const std::string& source_line) {
  if (source_line.empty()) return summary;
  constexpr std::size_t kBefore = 100, kAfter = 60;
  const std::size_t at = std::min(column > 0 ? static_cast<std::size_t>(column - 1) : 0, source_line.size());
  std::size_t begin = at > kBefore ? at - kBefore : 0;
  while (begin < at && continues_a_character(source_line[begin])) ++begin;
  std::size_t end = std::min(source_line.size(), at + kAfter);
  while (end < source_line.size() && continues_a_character(source_line[end])) ++end;
  const std::string cut_before = begin > 0 ? "..." : "", cut_after = end < source_line.size() ? "..." : "";
  std::string caret(cut_before.size(), ' ');
  for (std::size_t i = begin; i < at; ++i)
    if (!continues_a_character(source_line[i])) caret += source_line[i] == '\t' ? '\t' : ' ';
  return summary + "\n  " + cut_before + printable(source_line.substr(begin, end - begin)) + cut_after + "\n  " +
         caret + "^";
}

}  // namespace

InputError::InputError(const std::string& where, const std::string& message)
    : std::runtime_error(printable(where + ": error: " + message)), summary_(std::runtime_error::what()) {}

InputError::InputError(const std::string& file, int line, int column, const std::string& message,
                       const std::string& source_line)
    : std::runtime_error(with_excerpt(one_line(file, line, column, message), column, source_line)),
      summary_(one_line(file, line, column, message)) {}

}  // namespace photonproof::inline scenes_base
