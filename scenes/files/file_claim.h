// Marks a file as still in use by a process.
#pragma once

#include <filesystem>

namespace photonproof::inline scenes_files {

/// The system releases a claim when the process ends, however it ends; a renamed file keeps its claim.
class FileClaim {
 public:
  FileClaim() = default;
  ~FileClaim();
  FileClaim(const FileClaim&) = delete;
  FileClaim& operator=(const FileClaim&) = delete;

  /// Claims this file instead of the previous one. On a file system without locks, nothing is claimed.
  void move_to(const std::filesystem::path& file);

  /// Whether a claim, of this process or another, is on the file.
  static bool is_on(const std::filesystem::path& file);

 private:
  int descriptor_ = -1;
};

}  // namespace photonproof::inline scenes_files
