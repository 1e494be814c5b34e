// Trials of our own program, one subcommand each, in photonproof-trials, which only developers build.
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace photonproof::inline harness_trials {

/// Adds the subcommand to `program`; its callback leaves the process's exit code in `exit_code`.
void add_soak_trial(CLI::App& program, int& exit_code);
void add_faults_trial(CLI::App& program, int& exit_code);

/// The program under trial: `asked`, or the photonproof beside photonproof-trials if it is empty. Throws InputError
/// where the file does not exist.
std::filesystem::path program_on_trial(const std::filesystem::path& asked);

}  // namespace photonproof::inline harness_trials
