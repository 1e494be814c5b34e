#include "harness/cells/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <optional>
#include <system_error>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;

std::string reason() { return std::generic_category().message(errno); }

// The process id in the lock file: 0 if the file is empty, nothing if it holds other text.
std::optional<long> holder_of(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t length = pread(descriptor, text.data(), text.size() - 1, 0);
  if (length <= 0) return 0;
  char* end = text.data();
  const long process = std::strtol(text.data(), &end, 10);
  if (process <= 0 || std::string(end) != "\n") return std::nullopt;
  return process;
}

// A user may have put something else under the lock's name. A link to another file must not be written to, and a pipe
// must not block.
int open_lock(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  const bool is_link = descriptor < 0 && errno == ELOOP;
  if (descriptor < 0 && !is_link) throw InputError(file.string(), "cannot be written: " + reason());
  struct stat found {};
  const bool is_ours = !is_link && fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink <= 1 &&
                       holder_of(descriptor);
  if (is_ours) return descriptor;
  if (!is_link) close(descriptor);
  throw InputError(file.string(),
                   "is not a lock of photonproof's, which is a file of one number: remove it or choose "
                   "another folder with -o");
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& remedy) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
  const fs::path file = folder / ".lock";
  // Close-on-exec: an engine must not keep the lock when this process has ended.
  descriptor_ = open_lock(file);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const bool is_held = errno == EWOULDBLOCK;
    const long holder = holder_of(descriptor_).value_or(0);
    const std::string why = is_held ? "another run is writing here" +
                                          (holder > 0 ? " (process " + std::to_string(holder) + ")" : std::string()) +
                                          "; " + remedy
                                    : "cannot be locked: " + reason();
    close(descriptor_);
    throw InputError((is_held ? folder : file).string(), why);
  }
  const std::string self = std::to_string(getpid()) + "\n";
  // Used only in the message above, so a full disk is no reason to stop here.
  [[maybe_unused]] const bool written =
      ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, self.data(), self.size(), 0) > 0;
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace photonproof::inline harness_cells
