#include "harness/verbs/usage/verb_usage.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>
#include <string_view>

#include "harness/verbs/usage/help_formatter.h"

namespace photonproof::inline harness_verbs_usage {

const ExitCode done{0, "done"};
const ExitCode bad_input{2, "bad input or usage, or too little memory"};
const ExitCode internal_error{70, "internal error"};
const ExitCode not_representable{3, "the other renderer cannot represent the scene; stderr says why"};
const ExitCode engine_failed{70, "the other renderer failed, or an internal error"};
const ExitCode nothing_written{130, "interrupted; nothing is written"};
const ExitCode interrupted_and_kept{130, "interrupted; the same command continues from what is finished"};

namespace {

constexpr std::string_view example_mark = "Example: ";

std::string description_of(const std::string& purpose, const std::vector<std::string>& examples) {
  std::string text = purpose + "\n";
  for (const std::string& example : examples) text.append("\n").append(example_mark).append(example);
  return text;
}

std::string exit_code_table(const std::vector<ExitCode>& exit_codes) {
  std::string table = "Exit codes:";
  for (const auto& [code, meaning] : exit_codes) {
    const std::string number = std::to_string(code);
    table += "\n  " + number + std::string(5 - number.size(), ' ') + meaning;
  }
  return table;
}

}  // namespace

CLI::App* add_verb(CLI::App& program, const VerbUsage& usage) {
  CLI::App* verb = program.add_subcommand(usage.name, description_of(usage.purpose, usage.examples));
  verb->group(usage.group);
  const std::string notes = usage.notes.empty() ? "" : usage.notes + "\n\n";
  const std::string& page = usage.page.empty() ? usage.name : usage.page;
  verb->footer(notes + exit_code_table(usage.exit_codes) + "\n\nMore: docs/verbs/" + page + ".md");
  return verb;
}

void begin_program_usage(CLI::App& program, const std::string& purpose, const std::vector<std::string>& examples) {
  program.description(description_of(purpose, examples));
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "print this help");
}

void finish_program_usage(CLI::App& program, const std::vector<ExitCode>& exit_codes, const std::string& notes) {
  program.footer(exit_code_table(exit_codes) + "\n\n" + notes);
}

std::vector<std::string> examples_of(const CLI::App& app) {
  std::vector<std::string> examples;
  std::istringstream lines(app.get_description());
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(example_mark)) examples.push_back(line.substr(example_mark.size()));
  return examples;
}

void begin_option_group(CLI::App& app, const char* group) { app.option_defaults()->group(group); }

}  // namespace photonproof::inline harness_verbs_usage
