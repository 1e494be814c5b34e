// The one exception for bad input: scene files, suites, images, command-line values.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace photonproof::inline scenes_base {

/// The place of an entity in the input files; line and column count from 1, 0 means unknown.
struct SourceLoc {
  int file = 0;  ///< index into SceneDescription::files
  int line = 0;
  int column = 0;
  friend bool operator==(const SourceLoc&, const SourceLoc&) = default;
};

/// `what()` is "file:line:col: error: message" and, where the source is known, the source line and a caret below it.
/// `summary()` is its first line alone. The program prints the summary (plus the excerpt on a terminal) and exits with
/// 2. File names and quoted texts are untrusted: terminal control characters are shown as '?'.
class InputError : public std::runtime_error {
 public:
  /// An error about a whole file or value, without a position: "where: error: message".
  InputError(const std::string& where, const std::string& message);
  /// An error at a position; `source_line` may be empty.
  InputError(const std::string& file, int line, int column, const std::string& message,
             const std::string& source_line = {});
  /// All of `errors`, which are at least one, in one. `summary()` is the first one's and states the number of the
  /// others. Errors of the same text are told once, with all their places. `hint` is the last line, where there are
  /// several.
  InputError(const std::vector<InputError>& errors, const std::string& hint);

  const std::string& summary() const { return summary_; }
  /// The summary; of several errors one line each.
  const std::string& report() const { return report_; }
  /// "file:line:col", or the name of a whole file or value.
  const std::string& place() const { return place_; }
  int line() const { return line_; }      ///< 0 without a position
  int column() const { return column_; }  ///< 0 without a position
  /// The text behind "error: ".
  const std::string& message() const { return message_; }

 private:
  std::string summary_, report_, place_, message_;
  int line_ = 0, column_ = 0;
};

}  // namespace photonproof::inline scenes_base
