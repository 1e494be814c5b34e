// A folder for a child process's files, gone when the object is.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof {

class TemporaryFolder {
 public:
  /// Private to the user, in the system's folder for temporary files; its name says what it is for. Removes those that
  /// killed processes of the same user left. Throws InputError when it cannot be made.
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace photonproof
