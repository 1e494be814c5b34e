// Builds the command line around a contained command. A script in a mount namespace of its own makes the file system in
// memory, copies in, and runs bwrap with the command. It copies out when the command's process namespace is gone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/sandbox/control_groups.h"
#include "harness/sandbox/sandbox.h"

namespace photonproof::inline harness_sandbox {

/// Method of isolation for a command.
enum class Containment {
  none,           ///< only limits
  by_root,        ///< we are root: the command gets a uid without a user
  in_user_space,  ///< we are not root: a user namespace
};

/// Input of the script, and its results in a folder of the caller's: `status` with lines "key value", `errors`.
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
