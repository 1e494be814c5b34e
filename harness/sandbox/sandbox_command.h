// The command lines around a contained command: a script of ours in a mount namespace of its own makes the file system
// in memory, copies in, runs bwrap with the command, and copies out when the command's process namespace is gone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/sandbox/control_groups.h"
#include "harness/sandbox/sandbox.h"

namespace photonproof::inline harness_sandbox {

/// How a command is kept apart.
enum class Containment {
  none,           ///< limits alone
  by_root,        ///< we are root: the command gets a uid that nobody has
  in_user_space,  ///< we are not: a user namespace
};

/// What the script is told, and leaves, in a folder of the caller's: `status` with lines "key value", `errors`.
struct SandboxJob {
  std::filesystem::path folder;
  Containment containment;
  const SandboxOptions& options;
  const ControlGroups& groups;
};

/// Writes what the script needs into the job's folder. Throws InputError when it cannot.
void prepare_folder(const SandboxJob& job);

/// The whole command line, for run_process.
std::vector<std::string> sandbox_command(const std::vector<std::string>& argv, const SandboxJob& job);

}  // namespace photonproof::inline harness_sandbox
