#include "harness/cells/run_follower.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <optional>
#include <thread>
#include <utility>

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;

/// A state of a file; a replaced file has another time or size.
using FileState = std::optional<std::pair<fs::file_time_type, std::uintmax_t>>;

FileState state_of(const fs::path& file) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error);
  if (error) return std::nullopt;
  const auto size = fs::file_size(file, error);
  return error ? FileState() : FileState({time, size});
}

bool is_interrupted(const Follow& follow) { return follow.interrupt != nullptr && *follow.interrupt; }

/// Sleeps in short steps, so that an interrupt ends it soon.
void sleep_unless_interrupted(const Follow& follow) {
  constexpr double step = 0.05;
  for (double left = follow.seconds_between; left > 0 && !is_interrupted(follow); left -= step)
    std::this_thread::sleep_for(duration<double>(std::min(left, step)));
}

}  // namespace

bool is_run_going(const fs::path& folder) {
  const fs::path file = folder / ".lock";
  long process = 0;
  if (!(std::ifstream(file) >> process) || process <= 0) return false;
  if (kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) return false;
  // The number may be another process's by now, and then nobody holds the lock.
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool is_held = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  return is_held;
}

FollowEnd follow_run(const Follow& follow, const std::function<void()>& changed) {
  const fs::path parent = follow.record.parent_path(), folder = parent.empty() ? fs::path(".") : parent;
  FileState met;
  while (!is_interrupted(follow)) {
    if (!is_run_going(folder)) return FollowEnd::run_ended;
    if (const FileState now = state_of(follow.record); now && now != met) {
      met = now;
      changed();
    }
    sleep_unless_interrupted(follow);
  }
  return FollowEnd::interrupted;
}

}  // namespace photonproof::inline harness_cells
