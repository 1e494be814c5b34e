// Trials of our own program, a subcommand each. They belong to photonproof-trials, which only developers build.
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace photonproof::inline harness_trials {

/// Adds the subcommand to `program`; its callback leaves the process's exit code in `exit_code`.
void add_soak_trial(CLI::App& program, int& exit_code);
void add_faults_trial(CLI::App& program, int& exit_code);

/// The program that a trial runs: `asked`, or the photonproof beside photonproof-trials where it is empty. Throws
/// InputError where the file does not exist.
std::filesystem::path program_on_trial(const std::filesystem::path& asked);

}  // namespace photonproof::inline harness_trials
