#include "harness/verbs/usage/name_hints.h"

#include <algorithm>
#include <filesystem>

#include "scenes/base/edit_distance.h"

namespace photonproof::inline harness_verbs_usage {
namespace {

/// The program and the subcommands that were named, outermost first.
std::vector<const CLI::App*> named_apps(const CLI::App& program) {
  std::vector<const CLI::App*> apps{&program};
  while (!apps.back()->get_subcommands().empty()) apps.push_back(apps.back()->get_subcommands().back());
  return apps;
}

/// "photonproof render" for the second of the apps.
std::string command_to(const std::vector<const CLI::App*>& apps, std::size_t last) {
  std::string command = std::filesystem::path(apps.front()->get_name()).filename().string();
  for (std::size_t i = 1; i <= last; ++i) command += " " + apps[i]->get_name();
  return command;
}

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); }))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options({}))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The option or the name of a subcommand that an app did not expect. Empty where it is neither.
std::string unknown_name(const CLI::App& app, const std::string& command) {
  for (const std::string& word : app.remaining()) {
    const bool is_option = word.size() > 1 && word.starts_with('-') && word != "--";
    const std::vector<std::string> verbs = verbs_of(app);
    if (!is_option && verbs.empty()) continue;
    const std::string name = is_option ? word.substr(0, word.find('=')) : word;
    const std::string kind = is_option ? "option" : app.get_parent() == nullptr ? "verb" : "subcommand";
    const std::string hint = did_you_mean(name, is_option ? options_of(app) : verbs);
    return "unknown " + kind + " '" + name + "'" + hint + "; " + command + " --help lists all";
  }
  return "";
}

}  // namespace

std::string complaint_about(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<const CLI::App*> apps = named_apps(program);
  const std::string command = command_to(apps, apps.size() - 1);
  const std::string kind = error.get_name();
  if (kind != "ValidationError" && kind != "ConversionError")
    for (std::size_t i = 0; i < apps.size(); ++i)
      if (std::string unknown = unknown_name(*apps[i], command_to(apps, i)); !unknown.empty()) return unknown;
  const std::vector<std::string> verbs = verbs_of(*apps.back());
  if (kind == "RequiredError" && !verbs.empty())
    return (apps.size() > 1 ? command + ": expected " + join_or(verbs) : "expected a verb") + "; " + command +
           " --help lists all";
  return std::string(error.what()) + "; " + command + " --help lists all options";
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  const auto check = [names](const std::string& text) {
    if (std::ranges::find(names, text) != names.end()) return std::string();
    return "unknown '" + text + "'" + did_you_mean(text, names) + ", expected " + join_or(names);
  };
  return {check, "{" + CLI::detail::join(names, ",") + "}"};
}

}  // namespace photonproof::inline harness_verbs_usage
