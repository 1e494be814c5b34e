#include "scenes/files/scratch_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_files {
namespace {

namespace fs = std::filesystem;

/// Whether the folder belongs to this user and to a process that has ended.
bool is_abandoned(const fs::path& folder, const std::string& start) {
  const std::string name = folder.filename().string();
  if (!name.starts_with(start)) return false;
  pid_t process = 0;
  const auto [stop, problem] = std::from_chars(name.data() + start.size(), name.data() + name.size(), process);
  struct stat found {};
  return problem == std::errc{} && *stop == '-' && process > 0 && lstat(folder.c_str(), &found) == 0 &&
         S_ISDIR(found.st_mode) && found.st_uid == geteuid() && kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

ScratchFolder::ScratchFolder(const std::string& purpose) {
  std::error_code error, ignored;
  fs::path parent = fs::temp_directory_path(error);
  if (error) parent = "/tmp";
  const std::string start = "photonproof-" + purpose + "-";
  for (fs::directory_iterator entry(parent, error), none; !error && entry != none; entry.increment(error))
    if (is_abandoned(entry->path(), start))
      if (const auto hold = FolderHold::take(entry->path())) fs::remove_all(entry->path(), ignored);
  // Before we hold it, a process of another namespace may take it for a leftover.
  while (!hold_) {
    std::string name = (parent / (start + std::to_string(getpid()) + "-XXXXXX")).string();
    if (!mkdtemp(name.data()))
      throw InputError(name, "cannot be made for temporary files: " + std::generic_category().message(errno));
    path_ = name;
    hold_ = FolderHold::take(path_);
  }
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;  // a leftover in the temporary folder is no reason to fail
  fs::remove_all(path_, ignored);
}

}  // namespace photonproof::inline scenes_files
