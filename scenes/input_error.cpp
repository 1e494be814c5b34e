#include "scenes/input_error.h"

namespace photonproof {
namespace {

std::string one_line(const std::string& file, int line, int column, const std::string& message) {
  return file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": error: " + message;
}

std::string with_excerpt(const std::string& summary, int column, const std::string& source_line) {
  if (source_line.empty()) return summary;
  std::string caret;
  for (int i = 1; i < column; ++i) {
    const auto at = static_cast<std::size_t>(i - 1);
    caret += at < source_line.size() && source_line[at] == '\t' ? '\t' : ' ';
  }
  return summary + "\n  " + source_line + "\n  " + caret + "^";
}

}  // namespace

InputError::InputError(const std::string& where, const std::string& message)
    : std::runtime_error(where + ": error: " + message), summary_(where + ": error: " + message) {}

InputError::InputError(const std::string& file, int line, int column, const std::string& message,
                       const std::string& source_line)
    : std::runtime_error(with_excerpt(one_line(file, line, column, message), column, source_line)),
      summary_(one_line(file, line, column, message)) {}

}  // namespace photonproof
