// A folder for a child process's files, gone when the object is.
#pragma once

#include <filesystem>

namespace photonproof::reports {

class TemporaryFolder {
 public:
  /// Private to the user. Throws InputError when the system's folder for temporary files cannot be written.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace photonproof::reports
