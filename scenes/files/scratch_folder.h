// A folder for a child process's files, removed with the object.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scenes/files/folder_hold.h"

namespace photonproof::inline scenes_files {

class ScratchFolder {
 public:
  /// Private to the user, in the system's folder for temporary files, with `purpose` in its name. Removes folders left
  /// by killed processes of the same user. Throws InputError when it cannot be made.
  explicit ScratchFolder(const std::string& purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FolderHold> hold_;
};

}  // namespace photonproof::inline scenes_files
