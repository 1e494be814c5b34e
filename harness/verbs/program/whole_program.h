// The whole program: every verb in its group.
#pragma once

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_program {

/// Adds all verbs and the program's own help; the verb that runs leaves the process's exit code in `exit_code`.
void make_whole_program(CLI::App& program, int& exit_code);

}  // namespace photonproof::inline harness_verbs_program
