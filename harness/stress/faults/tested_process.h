// A process under test: killed, starved of disk, or run twice at once.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

/// How a process ended.
struct ProcessEnd {
  bool hung = false;  ///< It did not end in time and was killed for that.
  bool exited = false;
  int code = 0;    ///< The exit code, if it exited.
  int signal = 0;  ///< The signal, if it did not exit.
  std::string standard_error;

  /// True if it ended by itself with an exit code that the program documents. A crash, exit code 70 or a hang is not.
  bool is_orderly() const;
  std::string sentence() const;  ///< "exited with 2: <last line of standard error>", "killed by SIGSEGV", ...
};

class TestedProcess {
 public:
  /// Starts `argv`, looked up on PATH, as the leader of its own process group. Its output goes to the files out.txt and
  /// err.txt of `folder`. Throws InputError where it cannot be started.
  TestedProcess(const std::vector<std::string>& argv, const std::filesystem::path& folder);
  /// Kills the remaining processes.
  ~TestedProcess();
  TestedProcess(const TestedProcess&) = delete;
  TestedProcess& operator=(const TestedProcess&) = delete;

  /// Sends the signal to this process alone, as a user or a scheduler does who knows of no others.
  void send(int signal_number) const;
  /// Empty where it has not ended within that time; may be called again.
  std::optional<ProcessEnd> wait(double seconds);
  /// Like `wait`, but after that time it kills the process and reports a hang.
  ProcessEnd end(double seconds);

 private:
  const ProcessEnd& ended_with(int status, bool hung);

  pid_t pid_ = 0;
  std::optional<ProcessEnd> end_;
  std::filesystem::path folder_;
};

/// Whether a process of this machine has the text in its command line.
bool runs_with(const std::string& text);

}  // namespace photonproof::inline harness_stress_faults
