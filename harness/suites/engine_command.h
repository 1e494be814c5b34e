// Turns an engine's command template into the arguments of one process, and into the line a person would type.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_suites {

/// The values of a template's placeholders. A version command has {photonproof} and {suite} only.
struct CommandValues {
  std::filesystem::path photonproof;  ///< this program
  std::filesystem::path suite;        ///< the suite's folder
  std::filesystem::path scene, output, stats;
  std::string scene_name;     ///< of the suite
  int width = 0, height = 0;  ///< pixels
  int threads = 0;
  std::uint64_t seed = 0;
  Budget budget;
};

enum class CommandUse { render, version };

/// The reason why the template cannot be used; empty if it can. It may be empty, or have an unknown placeholder, a
/// brace without placeholder, or {budget} as only part of an argument. One that renders needs {output}, and {scene} or
/// {scene_name}.
std::optional<std::string> command_problem(const std::vector<std::string>& command, CommandUse use);

/// Whether a command's program is a path that starts from the suite's folder: a relative one, not a name for PATH.
bool is_from_suite(const std::string& program);

/// Advice for a command whose program cannot start, as the end of a sentence: "; it is not on PATH: write {suite}/mine
/// for the one beside the suite". Empty without advice.
std::string start_hint(const std::vector<std::string>& command, const std::filesystem::path& suite_folder);
/// The same for a failed command: an argument names a file beside the suite that is not in the current folder.
std::string argument_hint(const std::vector<std::string>& command, const std::filesystem::path& suite_folder);

/// Whether an argument of the template has the placeholder, "{seed}".
bool mentions(const std::vector<std::string>& command, const char* placeholder);

/// The arguments. A relative path of a program in the template ("build/mine") is relative to the suite's folder,
/// wherever the command starts. Precondition: command_problem is empty.
std::vector<std::string> fill_command(const std::vector<std::string>& command, const CommandValues& values);

}  // namespace photonproof::inline harness_suites
