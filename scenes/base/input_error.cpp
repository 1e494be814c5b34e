#include "scenes/base/input_error.h"

#include <algorithm>
#include <unordered_map>

#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_base {
namespace {

std::string one_line(const std::string& file, int line, int column, const std::string& message) {
  return printable(file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": error: " + message);
}

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The source line (of a long one the part around the column) with a caret below `column`, a byte counted from 1.
std::string with_excerpt(const std::string& summary, int column, const std::string& source_line) {
  if (source_line.empty()) return summary;
  constexpr std::size_t kBefore = 100, kAfter = 60;
  const std::size_t at = std::min(column > 0 ? static_cast<std::size_t>(column - 1) : 0, source_line.size());
  std::size_t begin = at > kBefore ? at - kBefore : 0;
  while (begin < at && continues_a_character(source_line[begin])) ++begin;
  std::size_t end = std::min(source_line.size(), at + kAfter);
  while (end < source_line.size() && continues_a_character(source_line[end])) ++end;
  const std::string cut_before = begin > 0 ? "..." : "", cut_after = end < source_line.size() ? "..." : "";
  std::string caret(cut_before.size(), ' ');
  for (std::size_t i = begin; i < at; ++i)
    if (!continues_a_character(source_line[i])) caret += source_line[i] == '\t' ? '\t' : ' ';
  return summary + "\n  " + cut_before + printable(source_line.substr(begin, end - begin)) + cut_after + "\n  " +
         caret + "^";
}

struct Group {
  const InputError* first;
  std::vector<std::string> others;  // places
};

/// Errors of the same text together, in the order in which each text comes first.
std::vector<Group> groups_of(const std::vector<InputError>& errors) {
  std::vector<Group> groups;
  std::unordered_map<std::string, std::size_t> known;
  for (const InputError& error : errors) {
    const auto [found, is_new] = known.try_emplace(error.message(), groups.size());
    if (is_new)
      groups.push_back({&error, {}});
    else
      groups[found->second].others.push_back(error.place());
  }
  return groups;
}

/// ", and at scene.xml:7:3 and 12 more places"; empty without others.
std::string other_places(const Group& group) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, group.others.size()); ++i)
    text += (i == 0 ? ", and at " : ", ") + group.others[i];
  if (group.others.size() > kShown) text += " and " + std::to_string(group.others.size() - kShown) + " more places";
  return text;
}

template <class Text>
std::string lines_of(const std::vector<InputError>& errors, const std::string& hint, Text text_of) {
  if (errors.size() == 1) return text_of(errors.front());
  std::string lines;
  for (const Group& group : groups_of(errors)) {
    const std::string text = text_of(*group.first);
    const std::size_t end = std::min(text.find('\n'), text.size());  // an excerpt comes below
    lines += text.substr(0, end) + printable(other_places(group)) + text.substr(end) + "\n";
  }
  return lines + printable(hint);
}

std::string summary_of(const std::vector<InputError>& errors) {
  if (errors.size() == 1) return errors.front().summary();
  return errors.front().summary() + " (and " + std::to_string(errors.size() - 1) + " more)";
}

}  // namespace

InputError::InputError(const std::string& where, const std::string& message)
    : std::runtime_error(printable(where + ": error: " + message)),
      summary_(std::runtime_error::what()),
      report_(summary_),
      place_(where),
      message_(message) {}

InputError::InputError(const std::string& file, int line, int column, const std::string& message,
                       const std::string& source_line)
    : std::runtime_error(with_excerpt(one_line(file, line, column, message), column, source_line)),
      summary_(one_line(file, line, column, message)),
      report_(summary_),
      place_(file + ":" + std::to_string(line) + ":" + std::to_string(column)),
      message_(message),
      line_(line),
      column_(column) {}

InputError::InputError(const std::vector<InputError>& errors, const std::string& hint)
    : std::runtime_error(lines_of(errors, hint, [](const InputError& e) { return std::string(e.what()); })),
      summary_(summary_of(errors)),
      report_(lines_of(errors, hint, [](const InputError& e) { return e.summary(); })),
      place_(errors.front().place()),
      message_(errors.front().message()),
      line_(errors.front().line()),
      column_(errors.front().column()) {}

}  // namespace photonproof::inline scenes_base
