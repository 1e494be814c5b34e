#include "harness/submissions/build_submission.h"

#include <cstdio>
#include <regex>
#include <sstream>

#include "harness/submissions/submission_tree.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kept_log = std::size_t{16} << 10;
constexpr std::size_t longest_line = 4096;  // std::regex recurses by character

std::string last_part(const std::string& text, std::size_t bytes) {
  return text.size() <= bytes ? text : text.substr(text.size() - bytes);
}

// The first line with an error of a compiler or linker: "render.cpp:7:5: error: ...". Later errors follow from it, and
// make's last line only reports that there was one. Empty if there is none.
std::string first_error_line(const std::string& text) {
  static const std::regex names_error(R"(\berror(\[\w+\])?:|undefined reference to|CMake Error|No rule to make target)",
                                      std::regex::icase);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.size() < longest_line && std::regex_search(line, names_error)) return last_line(line);
  return {};
}

std::string build_sentence(const SandboxOutcome& outcome) {
  const ProcessOutcome& process = outcome.process;
  std::string message = first_error_line(process.standard_error);
  if (message.empty()) message = first_error_line(process.standard_output);
  if (message.empty()) message = last_line(process.standard_error);
  if (message.empty()) message = last_line(process.standard_output);
  std::string sentence = outcome_sentence("the build", outcome);
  if (process.end == ProcessOutcome::End::exited && !message.empty()) sentence += ": " + printable(message);
  return sentence;
}

}  // namespace

std::string outcome_sentence(const std::string& subject, const SandboxOutcome& outcome) {
  const std::string sentence = outcome.sentence();
  const bool passive = sentence.starts_with("killed") || sentence.starts_with("interrupted");
  return subject + (passive ? " was " : " ") + sentence;
}

std::string log_tail(const ProcessOutcome& process) {
  return last_part(last_part(process.standard_output, kept_log / 2) + last_part(process.standard_error, kept_log / 2),
                   kept_log);
}

BuildOutcome build_submission(const fs::path& submission, const BuildRecipe& recipe, const fs::path& built,
                              const Handling& handling) {
  // Files are overwritten before the sandbox starts, on a copy of our own.
  const ScratchFolder scratch("build");
  const fs::path copy = scratch.path() / "copy";
  fs::copy(submission, copy, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  if (!recipe.overwrite.empty()) overwrite_files(recipe.overwrite, copy);
  fs::create_directories(built.parent_path());
  if (!fs::create_directory(built)) throw InputError(built.string(), "is there already");
  SandboxOptions options;
  options.working_folder = submission_inside;
  options.starts_with = copy;
  options.collect = ".";
  options.collect_to = fs::canonical(built);
  options.environment = recipe.environment;
  options.limits = recipe.limits;
  options.interrupt = handling.interrupt;
  options.contained = handling.contained;
  const std::vector<std::string> nothing{"true"};
  const SandboxOutcome outcome = run_sandboxed(recipe.command.empty() ? nothing : recipe.command, options);
  BuildOutcome result;
  result.ok = outcome.ok() && outcome.collected;
  result.timed_out = outcome.limit == "time";
  result.seconds = outcome.process.wall_seconds;
  result.cpu_seconds = outcome.process.all_cpu_seconds;
  result.log_tail = log_tail(outcome.process);
  char took[64];
  std::snprintf(took, sizeof took, "built in %.1f s", result.seconds);
  result.sentence = result.ok ? took : build_sentence(outcome);
  if (!result.ok) fs::remove_all(built);
  return result;
}

std::vector<std::string> with_values(const std::vector<std::string>& command,
                                     const std::map<std::string, std::string>& values) {
  std::vector<std::string> words;
  for (const std::string& pattern : command) {
    std::string word;
    for (std::size_t at = 0; at < pattern.size();) {
      const std::size_t end = pattern[at] == '{' ? pattern.find('}', at) : std::string::npos;
      if (end == std::string::npos) {
        word += pattern[at++];
        continue;
      }
      const auto value = values.find(pattern.substr(at + 1, end - at - 1));
      if (value == values.end()) throw InputError(pattern, "nothing is known by the name in braces");
      word += value->second;
      at = end + 1;
    }
    words.push_back(word);
  }
  return words;
}

}  // namespace photonproof::inline harness_submissions
