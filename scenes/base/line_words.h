// Words of a text's lines, for readers of files that have a statement a line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "scenes/base/text_position.h"

namespace photonproof::inline scenes_base {

class LineWords {
 protected:
  /// `file` stands for the file in messages. Both must outlive this.
  LineWords(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  /// Whether there is a line left; it is then the current one. Call skip_line() before the next.
  bool begin_line() {
    if (next_ >= text_.size()) return false;
    end_ = std::min(text_.find('\n', next_), text_.size());
    return true;
  }
  void skip_line() { next_ = end_ + 1; }

  /// The next word of the line, empty at its end.
  std::string_view word() {
    while (next_ < end_ && is_space(text_[next_])) ++next_;
    word_ = next_;
    while (next_ < end_ && !is_space(text_[next_])) ++next_;
    return text_.substr(word_, next_ - word_);
  }

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    fail_at_offset(file_, text_, offset, message);
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t next_ = 0, end_ = 0;  ///< in the line, and of it
  std::size_t word_ = 0;            ///< where the last word starts

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }
};

}  // namespace photonproof::inline scenes_base
