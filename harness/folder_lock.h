// One run at a time in a results folder.
#pragma once

#include <filesystem>

namespace photonproof {

/// Holds <folder>/.lock; the system lets go of it when the process ends, however it ends.
class FolderLock {
 public:
  /// Makes the folder when it is missing. Throws InputError when it cannot, or when another process holds the lock,
  /// naming that process.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace photonproof
