// The parts of a verb's --help besides its options: one line of purpose, examples, exit codes, and where its page is.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_usage {

struct ExitCode {
  int code;
  std::string meaning;
};

/// Exit codes that most verbs share.
extern const ExitCode done, bad_input, internal_error, interrupted_and_kept;
/// Exit codes of the verbs that use another renderer.
extern const ExitCode not_representable, engine_failed, nothing_written;

/// Groups of verbs in the program's --help, in this order.
constexpr const char* start_group = "Start";
constexpr const char* render_group = "Render";
constexpr const char* measure_group = "Measure";
constexpr const char* judge_group = "Judge";
constexpr const char* maintain_group = "Maintain";

/// Groups of options that several verbs have.
constexpr const char* input_group = "Input";
constexpr const char* output_group = "Output";
constexpr const char* run_group = "Run";

struct VerbUsage {
  std::string name;
  std::string group;
  std::string purpose;                ///< one line; the program's --help prints it, too
  std::vector<std::string> examples;  ///< whole command lines
  std::vector<ExitCode> exit_codes;
  std::string notes{};  ///< lines before the exit codes; empty: none
  std::string page{};   ///< its page in docs/verbs, without ".md"; empty: the verb's name
};

/// Adds a subcommand of this name, group and help. Its scenes or other subcommands inherit the exit codes.
CLI::App* add_verb(CLI::App& program, const VerbUsage& usage);

/// Sets the program's own help: the formatter of all help, `purpose`, `examples`, exit codes and `notes` after them.
/// Call it before the verbs are added; `finish_program_usage` goes after them, since verbs inherit footers.
void begin_program_usage(CLI::App& program, const std::string& purpose, const std::vector<std::string>& examples);
void finish_program_usage(CLI::App& program, const std::vector<ExitCode>& exit_codes, const std::string& notes);

/// The commands of the lines that begin with "Example: ".
std::vector<std::string> examples_of(const CLI::App& app);

/// Options added to `app` from here on belong to this group of its --help.
void begin_option_group(CLI::App& app, const char* group);

}  // namespace photonproof::inline harness_verbs_usage
