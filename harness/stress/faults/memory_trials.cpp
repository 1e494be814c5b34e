#include <algorithm>

#include "harness/stress/faults/fault_rows.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

constexpr const char* limit_kib = "262144";  // 256 MiB

std::vector<std::string> with_little_memory(const std::vector<std::string>& command) {
  std::vector<std::string> words{"sh", "-c", "ulimit -v \"$1\" && shift && exec \"$@\"", "sh", limit_kib};
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

/// Commands that cannot fit into the limit: a large image, a landscape.
std::vector<std::vector<std::string>> commands_too_large(const Trial& trial) {
  const std::string program = trial.place.program.string(), scene = (trial.place.inputs / "scene/scene.xml").string(),
                    image = (trial.place.out / "large.exr").string();
  std::vector<std::vector<std::string>> commands;
  if (!trial.work.name.starts_with("render ")) return commands;
  const std::string integrator = trial.work.name.substr(std::string("render ").size());
  commands.push_back({program, "render", scene, "--integrator", integrator, "-o", image, "--size", "6000x6000", "--spp",
                      "1", "--quiet"});
  commands.push_back(
      {program, "generate", "million", "--triangles", "1e8", "-o", (trial.place.out / "large").string()});
  return commands;
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TrialResult little_memory_trial(const Trial& trial) {
  TrialResult result{1, {}};
  const ProcessEnd end = TestedProcess(with_little_memory(trial.work.command(trial.place)), trial.folder).end(patience);
  result.broken = what_is_disorderly(end);
  FinishedParts finished;
  if (result.broken.empty()) result.broken = what_was_lost(trial, {}, finished);
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, finished);
  for (const std::vector<std::string>& command : commands_too_large(trial)) {
    if (!result.broken.empty()) break;
    const ProcessEnd too_large = TestedProcess(with_little_memory(command), trial.folder).end(patience);
    if (!too_large.exited || too_large.hung || too_large.code != 2 || lines_in(too_large.standard_error) != 1)
      result.broken = command[1] + " of what cannot fit " + too_large.sentence();
  }
  return result;
}

}  // namespace photonproof::inline harness_stress_faults
