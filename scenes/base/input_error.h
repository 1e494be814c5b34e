// The one exception for bad input: scene files, suites, images, command-line values.
#pragma once

#include <stdexcept>
#include <string>

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
  const std::string& summary() const { return summary_; }

 private:
  std::string summary_;
};

}  // namespace photonproof::inline scenes_base
