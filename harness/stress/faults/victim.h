// A process that is about to be treated badly: killed, starved of disk, or run twice at once.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

/// How a process ended.
struct VictimEnd {
  bool hung = false;  ///< it did not end in time, and was killed for that
  bool exited = false;
  int code = 0;    ///< where it exited
  int signal = 0;  ///< where it did not
  std::string standard_error;

  /// It ended by itself, with an exit code that the program documents; a crash, 70 and a hang are none.
  bool is_orderly() const;
  std::string sentence() const;  ///< "exited with 2: <last line of standard error>", "killed by SIGSEGV", ...
};

class Victim {
 public:
  /// Starts `argv`, looked up on PATH, as the leader of a process group of its own; what it prints goes to the files
  /// out.txt and err.txt of `folder`. Throws InputError where it cannot be started.
  Victim(const std::vector<std::string>& argv, const std::filesystem::path& folder);
  /// Kills what is left.
  ~Victim();
  Victim(const Victim&) = delete;
  Victim& operator=(const Victim&) = delete;

  /// To the process alone, as a user or a scheduler does who knows of no others.
  void send(int signal_number) const;
  /// Empty where it has not ended within that time; may be asked again.
  std::optional<VictimEnd> wait(double seconds);
  /// As `wait`, but kills it past that time, and says that it hung.
  VictimEnd end(double seconds);

 private:
  const VictimEnd& ended_with(int status, bool hung);

  pid_t pid_ = 0;
  std::optional<VictimEnd> end_;
  std::filesystem::path folder_;
};

/// Whether a process of this machine has the text in its command line.
bool runs_with(const std::string& text);

}  // namespace photonproof::inline harness_stress_faults
