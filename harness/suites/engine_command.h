// From an engine's command template to the arguments of one process, and to the line a person would type.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_suites {

/// What the placeholders of a template stand for. A version command knows {photonproof} and {suite} only.
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

/// Why the template cannot be used: it is empty, has an unknown placeholder or a brace that opens none, {budget} is
/// only part of an argument, or one that renders lacks {output} or both of {scene} and {scene_name}. Empty when it can.
std::optional<std::string> command_problem(const std::vector<std::string>& command, CommandUse use);

/// Whether a command's program is a path that starts from the suite's folder: a relative one, not a name for PATH.
bool is_from_suite(const std::string& program);

/// What to do about a command whose program cannot be started, as the end of a sentence: "; it is not on PATH: write
/// {suite}/mine for the one beside the suite". Empty where there is nothing to say.
std::string start_hint(const std::vector<std::string>& command, const std::filesystem::path& suite_folder);
/// The same of a command that failed: an argument that names a file beside the suite, and none in the current folder.
std::string argument_hint(const std::vector<std::string>& command, const std::filesystem::path& suite_folder);

/// Whether an argument of the template has the placeholder, "{seed}".
bool mentions(const std::vector<std::string>& command, const char* placeholder);

/// The arguments. A program that the template gives as a relative path ("build/mine") is meant from the suite's folder,
/// wherever the command is started. Precondition: command_problem is empty.
std::vector<std::string> fill_command(const std::vector<std::string>& command, const CommandValues& values);

}  // namespace photonproof::inline harness_suites
