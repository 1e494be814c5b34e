#include "harness/images/engine_version.h"

#include "harness/images/engine_run.h"
#include "harness/suites/engine_command.h"
#include "scenes/base/shell_text.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline harness_images {
namespace {

std::string first_line(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? std::string{} : text.substr(first, text.find_first_of("\r\n", first) - first);
}

/// "Cycles is not installed", and the reason that the command gives; the reason alone if it says the same.
std::string absence_words(const Engine& engine, const ProcessOutcome& outcome) {
  const std::string name = engine.title.empty() ? engine.name : engine.title;
  const std::string reason = printable(first_line(outcome.standard_error));
  const char* absent = " is not installed";
  if (reason.find(absent) != std::string::npos) return reason;
  return name + absent + (reason.empty() ? "" : ": " + reason);
}

}  // namespace

EngineVersion ask_version(const Engine& engine, const std::filesystem::path& suite_folder,
                          const std::filesystem::path& program, double most_seconds) {
  EngineVersion version;
  for (const auto& command : engine.version_commands) {
    CommandValues values;
    values.photonproof = program;
    values.suite = suite_folder;
    const std::vector<std::string> argv = fill_command(command, values);
    ProcessOptions options;
    options.wall_limit_seconds = most_seconds;
    const ProcessOutcome outcome = usual_executor().run(argv, options);
    if (!outcome.ok()) {
      version.problem = "the engine prints no version: '" + shell_line(argv) + "' " + outcome.sentence();
      using End = ProcessOutcome::End;
      const bool refuses = outcome.end == End::exited && outcome.exit_code == unsupported_exit_code;
      version.cells_end_as = refuses                           ? Status::unsupported
                             : outcome.end == End::not_started ? Status::not_started
                             : outcome.end == End::timed_out   ? Status::timeout
                                                               : Status::crash;
      if (refuses) version.problem = absence_words(engine, outcome);
      if (outcome.end == End::not_started) *version.problem += start_hint(command, suite_folder);
      return version;
    }
    // Some programs print it on standard error.
    std::string line = first_line(outcome.standard_output);
    if (line.empty()) line = first_line(outcome.standard_error);
    line = printable(line);
    version.line += (version.line.empty() ? "" : " + ") + line;
  }
  return version;
}

}  // namespace photonproof::inline harness_images
