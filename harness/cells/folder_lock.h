// One run at a time in a results folder.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline harness_cells {

/// Holds <folder>/.lock; the system releases it when the process ends, however it ends.
class FolderLock {
 public:
  /// Makes the folder when it is missing. Throws InputError when it cannot, or when the lock's name belongs to
  /// something else. It also throws when another process holds the lock, names that process and adds `remedy`.
  explicit FolderLock(const std::filesystem::path& folder,
                      const std::string& remedy = "wait for it or choose another folder with -o");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace photonproof::inline harness_cells
