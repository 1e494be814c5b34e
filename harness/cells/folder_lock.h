// One run at a time in a results folder.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline harness_cells {

/// Holds <folder>/.lock; the system lets go of it when the process ends, however it ends.
class FolderLock {
 public:
  /// Makes the folder when it is missing. Throws InputError when it cannot, when what lies under the lock's name is not
  /// a lock, or when another process holds it, naming that process; `remedy` says what to do then.
  explicit FolderLock(const std::filesystem::path& folder,
                      const std::string& remedy = "wait for it or choose another folder with -o");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace photonproof::inline harness_cells
