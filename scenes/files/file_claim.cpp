#include "scenes/files/file_claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace photonproof::inline scenes_files {
namespace {

/// Close-on-exec, for a child must not keep a claim; not waiting, for a pipe may lie under the name.
int open_quietly(const std::filesystem::path& file) { return open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }

void close_if_open(int descriptor) {
  if (descriptor >= 0) close(descriptor);
}

}  // namespace

FileClaim::~FileClaim() { close_if_open(descriptor_); }

void FileClaim::move_to(const std::filesystem::path& file) {
  const int next = open_quietly(file);
  if (next >= 0) flock(next, LOCK_EX | LOCK_NB);
  close_if_open(std::exchange(descriptor_, next));
}

bool FileClaim::is_on(const std::filesystem::path& file) {
  const int descriptor = open_quietly(file);
  const bool claimed = descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close_if_open(descriptor);
  return claimed;
}

}  // namespace photonproof::inline scenes_files
