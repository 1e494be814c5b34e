#include "harness/verbs/usage/help_formatter.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace photonproof::inline harness_verbs_usage {
namespace {

constexpr std::size_t page_width = 100, option_column = 30, verb_column = 13;
const std::string group_of_help = "Options";  // CLI11's name for it

/// The text in lines of at most `width`, broken between words.
std::vector<std::string> broken(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  return lines;
}

/// `name`, then `text` from `column` on.
std::string two_columns(const std::string& name, const std::string& text, std::size_t column) {
  std::string out = "  " + name;
  bool is_beside = out.size() < column;
  for (const std::string& line : broken(text, page_width - column)) {
    out += is_beside ? std::string(column - out.size(), ' ') : "\n" + std::string(column, ' ');
    out += line;
    is_beside = false;
  }
  return out + "\n";
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// A validator's description in words: "{a,b}" and "INT in [0 - 9]" are CLI11's.
std::string words_for(const std::string& validator) {
  if (validator.starts_with('{') && validator.ends_with('}')) {
    std::string words;
    for (const std::string& name : parts_of(validator.substr(1, validator.size() - 2), ','))
      words += (words.empty() ? "" : ", ") + name;
    return words;
  }
  const std::size_t open = validator.find(" in ["), middle = validator.find(" - ", open);
  if (open == std::string::npos || middle == std::string::npos || !validator.ends_with(']')) return validator;
  return validator.substr(open + 5, middle - open - 5) + " to " +
         validator.substr(middle + 3, validator.size() - middle - 4);
}

std::string names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);  // the set is in the order of addresses
  return CLI::detail::join(names, " or ");
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(option_column);
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  std::string out = app->get_description() + "\n\n" + make_usage(app, std::move(name)) + make_positionals(app), other;
  for (const std::string& group : app->get_groups()) {
    const std::vector<const CLI::Option*> options = app->get_options(
        [&](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
    if (group.empty() || options.empty()) continue;
    if (group == group_of_help)
      other = make_group("Other", false, options);
    else
      out += make_group(group, false, options);
  }
  return out + make_subcommands(app, mode) + other + "\n" + make_footer(app);
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::string out;
  for (const std::string& line : parts_of(app->get_footer(), '\n')) {
    if (line.size() <= page_width)
      out += line + "\n";
    else
      for (const std::string& part : broken(line, page_width)) out += part + "\n";
  }
  return out;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string left = make_option_name(option, is_positional);
  std::vector<std::string> facts;
  if (option->get_required()) facts.emplace_back("required");
  if (option->get_type_size() != 0) {
    std::vector<std::string> types = parts_of(option->get_type_name(), ':');
    if (!types.empty() && !is_positional && !types[0].empty()) left += " " + types[0];
    if (!option->get_default_str().empty()) facts.push_back("default: " + option->get_default_str());
    for (std::size_t i = 1; i < types.size(); ++i) facts.push_back(words_for(types[i]));
  }
  if (!option->get_needs().empty()) facts.push_back("needs " + names_of(option->get_needs()));
  if (!option->get_excludes().empty()) facts.push_back("not with " + names_of(option->get_excludes()));
  std::string text = option->get_description();
  if (!facts.empty()) {
    const bool goes_on = text.ends_with(')');
    if (goes_on) text.pop_back();
    text += (goes_on ? "; " : " (") + CLI::detail::join(facts, "; ") + ")";
  }
  return two_columns(left, text, option_column);
}

std::string HelpFormatter::make_subcommand(const CLI::App* subcommand) const {
  const std::string description = subcommand->get_description();
  return two_columns(subcommand->get_name(), description.substr(0, description.find('\n')), verb_column);
}

}  // namespace photonproof::inline harness_verbs_usage
