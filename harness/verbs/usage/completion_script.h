// Completion of verbs and options for shells, written from the program's own command line.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_usage {

enum class Shell { bash, zsh, fish };

/// A script to be sourced (bash) or put on the shell's path of functions (zsh: `_photonproof`, fish:
/// `photonproof.fish`). It completes verbs, their subcommands and options, and elsewhere names of files. Verbs without
/// a group and options without a text are left out.
std::string completion_script(const CLI::App& program, Shell shell);

}  // namespace photonproof::inline harness_verbs_usage
