// Runs one child process to its end, bounded in time and memory, and reports its cost. Used for POV-Ray and by the
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
  std::optional<double> wall_limit_seconds{};         ///< Past it, the child and all its descendants are killed.
  std::optional<std::uint64_t> memory_limit_bytes{};  ///< Sampled resident set of all these; killed past it.
  std::optional<std::uint64_t> output_limit_bytes{};  ///< Standard output and error together; killed past it.
  const std::atomic<bool>* interrupt = nullptr;       ///< Once true, the group gets SIGINT, after 2 s SIGKILL.
  std::filesystem::path working_folder{};             ///< Empty: the caller's.
  std::function<void(std::string_view)> on_stderr{};  ///< Gets each chunk as it arrives (progress); may be empty.
  std::optional<int> processor{};                     ///< The child and its children run on this one alone.
  bool samples_peak = true;  ///< False saves 2 % of time; without a memory limit `peak_bytes` may then be the caller's.
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
  int exit_code = 0;  ///< When `exited`.
  int signal = 0;     ///< When `signalled`.
  double wall_seconds = 0;
  double cpu_seconds = 0;      ///< User + system, of the child and the children it waited for.
  double all_cpu_seconds = 0;  ///< The same of all its descendants, and of the process that keeps them (about 1 ms).
  std::uint64_t peak_bytes =
      0;  ///< Largest resident set of one process: its own, without the part inherited from the caller.
  std::optional<std::uint64_t> instructions;  ///< In user mode, where the kernel counts them.
  std::string standard_output;                ///< The last 1 MiB.
  std::string standard_error;                 ///< The last 1 MiB.
  std::string cause;                          ///< The limit that was passed, or why it was not started; else empty.
  bool ok() const { return end == End::exited && exit_code == 0; }
  std::string sentence() const;  ///< "exited with 3", "killed by SIGSEGV", "killed after 10 s (limit)" ...
};

/// Runs without a shell; argv[0] is searched on PATH. Standard input is /dev/null; the child inherits no other
/// descriptor. The child leads a process group of its own. All its descendants, in any group or session, are killed
/// when the child ends or the caller dies. Limits and the interrupt are checked every 20 ms. Never throws for the
/// child's behaviour; throws std::system_error when the system has no more processes or file descriptors. May be called
/// on several threads at once. Precondition: argv is not empty.
ProcessOutcome run_process(const std::vector<std::string>& argv, const ProcessOptions& options = {});

/// The last line of a text that is not blank, without the blanks at its end; empty when there is none.
std::string last_line(const std::string& text);

}  // namespace photonproof::inline scenes_base
