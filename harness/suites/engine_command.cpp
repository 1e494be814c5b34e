#include "harness/suites/engine_command.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scenes/base/edit_distance.h"

namespace photonproof::inline harness_suites {
namespace {

constexpr const char* budget_placeholder = "{budget}";

struct Placeholder {
  const char* name;
  bool in_version_commands;
  std::string (*text)(const CommandValues&);
};

constexpr std::array<Placeholder, 11> placeholders{{
    {"photonproof", true, [](const CommandValues& v) { return v.photonproof.string(); }},
    {"suite", true, [](const CommandValues& v) { return v.suite.string(); }},
    {"scene", false, [](const CommandValues& v) { return v.scene.string(); }},
    {"scene_name", false, [](const CommandValues& v) { return v.scene_name; }},
    {"output", false, [](const CommandValues& v) { return v.output.string(); }},
    {"stats", false, [](const CommandValues& v) { return v.stats.string(); }},
    {"width", false, [](const CommandValues& v) { return std::to_string(v.width); }},
    {"height", false, [](const CommandValues& v) { return std::to_string(v.height); }},
    {"threads", false, [](const CommandValues& v) { return std::to_string(v.threads); }},
    {"seed", false, [](const CommandValues& v) { return std::to_string(v.seed); }},
    {"amount", false, [](const CommandValues& v) { return v.budget.amount_text(); }},
}};

const Placeholder* find_placeholder(std::string_view name, CommandUse use) {
  for (const Placeholder& placeholder : placeholders)
    if (placeholder.name == name && (use == CommandUse::render || placeholder.in_version_commands)) return &placeholder;
  return nullptr;
}

std::vector<std::string> placeholder_names(CommandUse use) {
  std::vector<std::string> names;
  for (const Placeholder& placeholder : placeholders)
    if (find_placeholder(placeholder.name, use) != nullptr) names.emplace_back(placeholder.name);
  if (use == CommandUse::render) names.emplace_back("budget");
  return names;
}

std::string known_placeholders(CommandUse use) {
  std::string names = use == CommandUse::render ? budget_placeholder : "";
  for (const Placeholder& placeholder : placeholders)
    if (find_placeholder(placeholder.name, use) != nullptr)
      names += (names.empty() ? "{" : " {") + std::string(placeholder.name) + "}";
  return names;
}

std::optional<std::string> argument_problem(const std::string& argument, CommandUse use) {
  if (argument == budget_placeholder && use == CommandUse::render) return std::nullopt;
  for (std::size_t open = argument.find('{'); open != std::string::npos; open = argument.find('{', open + 1)) {
    const std::size_t close = argument.find('}', open);
    const std::string name = close == std::string::npos ? std::string{} : argument.substr(open + 1, close - open - 1);
    if (name == "budget" && use == CommandUse::render)
      return "{budget} becomes two arguments and must stand alone, not in '" + argument + "'";
    if (find_placeholder(name, use) == nullptr)
      return "'" + argument + "' has an unknown placeholder" + did_you_mean(name, placeholder_names(use)) +
             "; known: " + known_placeholders(use);
  }
  return std::nullopt;
}

std::string filled(const std::string& argument, const CommandValues& values) {
  std::string text;
  std::size_t at = 0;
  for (std::size_t open = argument.find('{'); open != std::string::npos; open = argument.find('{', at)) {
    const std::size_t close = argument.find('}', open);
    text += argument.substr(at, open - at);
    text += find_placeholder(std::string_view(argument).substr(open + 1, close - open - 1), CommandUse::render)
                ->text(values);
    at = close + 1;
  }
  return text + argument.substr(at);
}

}  // namespace

bool mentions(const std::vector<std::string>& command, const char* placeholder) {
  return std::any_of(command.begin(), command.end(), [placeholder](const std::string& argument) {
    return argument.find(placeholder) != std::string::npos;
  });
}

std::optional<std::string> command_problem(const std::vector<std::string>& command, CommandUse use) {
  if (command.empty()) return "a command needs at least a program";
  for (const std::string& argument : command)
    if (auto problem = argument_problem(argument, use)) return problem;
  if (use == CommandUse::version) return std::nullopt;
  if (!mentions(command, "{scene}") && !mentions(command, "{scene_name}"))
    return "the command does not mention {scene} or {scene_name}";
  if (!mentions(command, "{output}")) return "the command does not mention {output}";
  return std::nullopt;
}

bool is_from_suite(const std::string& program) {
  return program.find('/') != std::string::npos && program.front() != '/' && program.front() != '{';
}

std::string start_hint(const std::vector<std::string>& command, const std::filesystem::path& suite_folder) {
  const std::string& program = command.front();
  std::error_code ignored;
  if (is_from_suite(program)) {
    const std::string from = "; a relative program starts from the suite's folder, {suite}: '" + suite_folder.string();
    return from + (std::filesystem::exists(program, ignored)
                       ? "', and not from the current one, which has it: write an absolute path or the one from there"
                       : "'");
  }
  if (program.find_first_of("/{") != std::string::npos) return "";
  return "; it is not on PATH" + (std::filesystem::exists(suite_folder / program, ignored)
                                      ? ": write {suite}/" + program + " for the one beside the suite"
                                      : "");
}

std::string argument_hint(const std::vector<std::string>& command, const std::filesystem::path& suite_folder) {
  for (std::size_t i = 1; i < command.size(); ++i) {
    const std::string& argument = command[i];
    std::error_code ignored;
    if (argument.empty() || argument.front() == '/' || argument.find('{') != std::string::npos) continue;
    if (std::filesystem::is_regular_file(suite_folder / argument, ignored) &&
        !std::filesystem::exists(argument, ignored))
      return "; for the '" + argument + "' beside the suite write {suite}/" + argument;
  }
  return "";
}

std::vector<std::string> fill_command(const std::vector<std::string>& command, const CommandValues& values) {
  std::vector<std::string> arguments;
  for (const std::string& argument : command) {
    if (argument == budget_placeholder) {
      arguments.push_back("--" + values.budget.kind);
      arguments.push_back(values.budget.amount_text());
    } else {
      arguments.push_back(filled(argument, values));
    }
  }
  if (is_from_suite(command.front())) {
    const std::filesystem::path program = (values.suite / command.front()).lexically_normal();
    arguments.front() = program.has_parent_path() ? program.string() : "./" + program.string();  // not on PATH
  }
  return arguments;
}

}  // namespace photonproof::inline harness_suites
