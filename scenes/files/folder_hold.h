// Marks a folder as still used by its maker, so that clean-up leaves it alone. A process's number is no proof: in
// another namespace of processes, as of a container with the same /tmp, it may belong to no process.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace photonproof::inline scenes_files {

class FolderHold {
 public:
  /// Empty where another process has it, or the folder is gone. On a file system without locks, every process gets it.
  static std::optional<FolderHold> take(const std::filesystem::path& folder);
  FolderHold(FolderHold&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderHold& operator=(FolderHold&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FolderHold();

 private:
  explicit FolderHold(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace photonproof::inline scenes_files
