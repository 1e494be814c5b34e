// Follows the record of a run that another process writes, until that run ends.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>

namespace photonproof::inline harness_cells {

/// Why following came to its end.
enum class FollowEnd { run_ended, interrupted };

struct Follow {
  std::filesystem::path record;                  ///< replaced as a whole while its folder is locked (folder_lock.h)
  double seconds_between = 1;                    ///< of looks at the record
  const std::atomic<bool>* interrupt = nullptr;  ///< ends following once true
};

/// Calls `changed` once for every state of the record that it meets while the run goes on. Returns after the run has
/// ended or the interrupt came, without a last call. A record that does not exist yet is waited for while its folder is
/// locked. A run that has ended before is no error.
FollowEnd follow_run(const Follow& follow, const std::function<void()>& changed);

/// Whether a live process holds the folder's lock. Does not disturb a run that starts meanwhile.
bool is_run_going(const std::filesystem::path& folder);

}  // namespace photonproof::inline harness_cells
