#include "scenes/base/text_position.h"

#include <algorithm>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_base {

void fail_at_offset(const std::string& file, std::string_view text, std::size_t offset, const std::string& message) {
  constexpr std::size_t kLongestLine = std::size_t{1} << 20;  // a longer one is no line, and is not shown
  offset = std::min(offset, text.size());
  const std::string_view before = text.substr(0, offset);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  std::string_view line = text.substr(start, text.find('\n', offset) - start);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  throw InputError(file, static_cast<int>(lines) + 1, static_cast<int>(offset - start) + 1, message,
                   line.size() > kLongestLine ? std::string() : std::string(line));
}

}  // namespace photonproof::inline scenes_base
