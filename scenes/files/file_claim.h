// Says of a file that somebody is still at work on it.
#pragma once

#include <filesystem>

namespace photonproof::inline scenes_files {

/// The system lets go of a claim when the process ends, however it ends; a file that is renamed keeps it.
class FileClaim {
 public:
  FileClaim() = default;
  ~FileClaim();
  FileClaim(const FileClaim&) = delete;
  FileClaim& operator=(const FileClaim&) = delete;

  /// Claims this file instead of the one before. Where the file system knows no locks, nothing is claimed.
  void move_to(const std::filesystem::path& file);

  /// Whether a claim, of this process or another, is on the file.
  static bool is_on(const std::filesystem::path& file);

 private:
  int descriptor_ = -1;
};

}  // namespace photonproof::inline scenes_files
