#include "scenes/files/folder_hold.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace photonproof::inline scenes_files {

std::optional<FolderHold> FolderHold::take(const std::filesystem::path& folder) {
  FolderHold hold(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW));
  if (hold.descriptor_ < 0) return std::nullopt;
  if (flock(hold.descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return std::nullopt;
  struct stat found {};
  const bool is_gone = fstat(hold.descriptor_, &found) != 0 || found.st_nlink == 0;
  if (is_gone) return std::nullopt;
  return hold;
}

FolderHold::~FolderHold() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace photonproof::inline scenes_files
