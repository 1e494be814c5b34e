// Runs one child process to its end, bounded in time and memory, and says what it cost. Used for POV-Ray and by the
// benchmark for every engine.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace photonproof::inline scenes_base {

struct ProcessOptions {
  std::optional<double> wall_limit_seconds{};         ///< the child and all its descendants are killed past it
  std::optional<std::uint64_t> memory_limit_bytes{};  ///< resident set of the same, sampled; killed past it
  std::optional<std::uint64_t> output_limit_bytes{};  ///< of standard output and error together; killed past it
  const std::atomic<bool>* interrupt = nullptr;       ///< when it turns true the group gets SIGINT, after 2 s SIGKILL
  std::filesystem::path working_folder{};             ///< empty: the caller's
  std::function<void(std::string_view)> on_stderr{};  ///< sees each chunk as it arrives (progress); may be empty
  std::optional<int> processor{};                     ///< the child and its children run on this one alone
  bool samples_peak = true;  ///< else, with no memory limit, `peak_bytes` may be the caller's: saves 2 % of the time
};

struct ProcessOutcome {
  enum class End {
    exited,
    signalled,
    timed_out,
    out_of_memory,
    too_much_output,
    interrupted,
    not_started
  } end = End::not_started;
  int exit_code = 0;  ///< when `exited`
  int signal = 0;     ///< when `signalled`
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< user + system, of the child and the children it waited for
  double all_cpu_seconds =
      0;  ///< the same of all that descended from it, and of the process that kept them (about 1 ms)
  std::uint64_t peak_bytes =
      0;  ///< largest resident set of one process: its own, not what it inherited from the caller
  std::optional<std::uint64_t> instructions;  ///< in user mode, where the kernel counts them
  std::string standard_output;                ///< the last 1 MiB
  std::string standard_error;                 ///< the last 1 MiB
  std::string cause;                          ///< the limit that was passed, or why it was not started; empty otherwise
  bool ok() const { return end == End::exited && exit_code == 0; }
  std::string sentence() const;  ///< "exited with 3", "killed by SIGSEGV", "killed after 10 s (limit)" ...
};

/// No shell: argv[0] is looked up on PATH. Standard input is /dev/null; no other descriptor of ours is the child's. The
/// child leads a process group of its own. Whatever descends from it, in any group or session, is killed when the child
/// ends or the caller dies. Limits and the interrupt are looked at every 20 ms. Never throws for what the child does;
/// throws std::system_error when the system has no more processes or file descriptors. May be called on several threads
/// at once. Precondition: argv is not empty.
ProcessOutcome run_process(const std::vector<std::string>& argv, const ProcessOptions& options = {});

/// The last line of a text that is not blank, without the blanks at its end; empty when there is none.
std::string last_line(const std::string& text);

}  // namespace photonproof::inline scenes_base
