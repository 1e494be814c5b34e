#include "harness/sandbox/sandbox.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "harness/sandbox/control_groups.h"
#include "harness/sandbox/sandbox_command.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_sandbox {
namespace {

namespace fs = std::filesystem;
using End = ProcessOutcome::End;

constexpr int shell_adds_to_signals = 128;  // in exit codes of commands that a signal ended, also by bwrap

// Values that the script left (sandbox_command.cpp).
struct ScriptStatus {
  std::string stage, kind;
  bool ended = false, collected = false, too_large = false;
  int code = 0;
  double seconds = 0;
  std::uint64_t blocks_free = 1, files_free = 1;
};

ScriptStatus read_status(const fs::path& file) {
  ScriptStatus status;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key >> std::ws;
    if (key == "stage") words >> status.stage;
    if (key == "kind") std::getline(words, status.kind);
    status.collected |= key == "collected";
    status.too_large |= key == "too_large";
    if (key == "ended") {
      double begin = 0, end = 0;
      status.ended = static_cast<bool>(words >> status.code >> begin >> end);
      status.seconds = end - begin;
      words >> status.blocks_free >> status.files_free;
    }
  }
  return status;
}

std::string first_line_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// Replaces the script's end by that of the command in it.
void set_end(ProcessOutcome& process, const ScriptStatus& status) {
  if (process.end != End::exited) return;
  if (status.ended) {
    process.wall_seconds = std::clamp(status.seconds, 0.0, process.wall_seconds);
    process.exit_code = status.code;
  }
  constexpr int last_signal = 64;
  if (process.exit_code > shell_adds_to_signals && process.exit_code <= shell_adds_to_signals + last_signal) {
    process.end = End::signalled;
    process.signal = process.exit_code - shell_adds_to_signals;
    process.exit_code = 0;
  }
  constexpr std::string_view not_found = "prlimit: failed to execute ";
  const std::size_t at = process.standard_error.rfind(not_found);
  if (process.end == End::exited && (process.exit_code == 126 || process.exit_code == 127) && at != std::string::npos) {
    process.end = End::not_started;
    process.cause = last_line(process.standard_error.substr(at + not_found.size()));
  }
}

std::string met_limit(const ProcessOutcome& process, const ScriptStatus& status, const ControlGroups& groups,
                      bool contained) {
  if (process.end == End::timed_out) return "time";
  if (process.end == End::out_of_memory || groups.memory_ran_out()) return "memory";
  if (process.end == End::too_much_output) return "log";
  if (process.end == End::interrupted || process.ok()) return status.too_large ? "file size" : "";
  if (process.end == End::signalled && process.signal == SIGXCPU) return "processor time";
  if (process.end == End::signalled && process.signal == SIGXFSZ) return "file size";
  if (contained && (status.blocks_free == 0 || status.files_free == 0)) return "disk";
  return groups.processes_ran_out() ? "processes" : "";
}

SandboxOutcome run_in(const std::vector<std::string>& argv, const SandboxOptions& options, Containment containment) {
  const bool contained = containment != Containment::none;
  const SandboxLimits& limits = options.limits;
  const ScratchFolder scratch("sandbox");
  // Files in memory count as the group's too.
  const ControlGroups groups(limits.memory_bytes + (contained ? limits.disk_bytes : 0), limits.processes + 4);
  const SandboxJob job{scratch.path(), containment, options, groups};
  prepare_folder(job);
  ProcessOptions process_options;
  process_options.wall_limit_seconds = limits.wall_seconds;
  process_options.memory_limit_bytes = limits.memory_bytes;
  process_options.output_limit_bytes = limits.log_bytes;
  process_options.interrupt = options.interrupt;
  SandboxOutcome outcome;
  outcome.process = run_process(sandbox_command(argv, job), process_options);
  const ScriptStatus status = read_status(scratch.path() / "status");
  const std::string error = first_line_of(scratch.path() / "errors");
  if (status.stage == "collect" && status.ended && outcome.process.end == End::exited)
    throw InputError(options.collect_to.string(), "cannot be written: " + error);
  const bool failed_before = outcome.process.end == End::exited && status.stage != "run" && !status.ended;
  if (failed_before) {
    outcome.process.end = End::not_started;
    outcome.process.cause = !error.empty() ? error : last_line(outcome.process.standard_error);
    if (error.ends_with("No space left on device")) outcome.limit = "disk";
    return outcome;
  }
  set_end(outcome.process, status);
  outcome.limit = met_limit(outcome.process, status, groups, contained);
  outcome.collected_kind = status.kind;
  outcome.collected = status.collected;
  outcome.special = first_line_of(scratch.path() / "special");
  return outcome;
}

struct Containable {
  std::optional<Containment> containment;
  std::string why_not;
};

Containable find_out() {
  SandboxOptions options;
  options.limits.wall_seconds = 30;
  Containable found;
  std::vector<Containment> ways{Containment::in_user_space};
  if (geteuid() == 0) ways.insert(ways.begin(), Containment::by_root);
  for (const Containment way : ways) {
    const SandboxOutcome outcome = run_in({"true"}, options, way);
    if (outcome.ok()) return {way, {}};
    const std::string message = last_line(outcome.process.standard_error);
    found.why_not = message.empty() ? outcome.sentence() : message;
  }
  return found;
}

// Tested once, since the answer does not change and a test costs some 30 ms.
const Containable& containable() {
  static const Containable found = find_out();
  return found;
}

}  // namespace

std::optional<std::string> why_no_sandbox() {
  if (containable().containment) return std::nullopt;
  return "programs cannot be contained here, bubblewrap (bwrap) failed: " + containable().why_not;
}

bool is_part_of_system(const fs::path& path) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(path, ignored);
  auto part = whole.begin();
  if (part == whole.end() || ++part == whole.end()) return true;  // the root holds the system
  static const std::array<fs::path, 7> parts{"usr", "bin", "sbin", "lib", "lib32", "lib64", "libx32"};
  return std::find(parts.begin(), parts.end(), *part) != parts.end();
}

SandboxOutcome run_sandboxed(const std::vector<std::string>& argv, const SandboxOptions& options) {
  if (!options.contained) return run_in(argv, options, Containment::none);
  if (const auto why = why_no_sandbox()) throw InputError(argv[0], "must not run: " + *why);
  return run_in(argv, options, *containable().containment);
}

std::string SandboxOutcome::sentence() const {
  if (limit == "memory" && process.end != End::out_of_memory) return "ran out of memory (limit)";
  if (limit == "processor time") return "used more processor time than allowed (limit)";
  if (limit == "file size") return "wrote a file larger than allowed (limit)";
  if (limit == "disk") return "filled its disk (limit); " + process.sentence();
  if (limit == "processes") return "was refused more processes (limit); " + process.sentence();
  return process.sentence();
}

}  // namespace photonproof::inline harness_sandbox
