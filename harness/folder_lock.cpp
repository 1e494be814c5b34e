#include "harness/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "scenes/input_error.h"

namespace photonproof {
namespace fs = std::filesystem;

FolderLock::FolderLock(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
  const fs::path file = folder / ".lock";
  // Close-on-exec: an engine must not keep the lock when this process is gone.
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw InputError(file.string(), "cannot be written: " + std::generic_category().message(errno));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    close(descriptor_);
    if (reason != EWOULDBLOCK)
      throw InputError(file.string(), "cannot be locked: " + std::generic_category().message(reason));
    std::string holder;
    std::getline(std::ifstream(file), holder);
    throw InputError(folder.string(), "another run is writing here" +
                                          (holder.empty() ? "" : " (process " + holder + ")") +
                                          "; wait for it or choose another folder with -o");
  }
  std::ofstream(file) << getpid() << '\n';
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace photonproof
