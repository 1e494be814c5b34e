#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reports/stress/stress_view.h"

namespace photonproof::reports::inline reports_stress {
namespace {

/// A climb of at least this many features is shown by the lowest one; other sweeps have a row each.
constexpr std::size_t many_features = 4;

std::string head(const std::vector<std::string>& first, const std::vector<std::string>& engines) {
  std::string text = "|", line = "|";
  for (const auto* columns : {&first, &engines})
    for (const std::string& column : *columns) {
      text += " " + column + " |";
      line += "---|";
    }
  return text + "\n" + line + "\n";
}

/// Features by climb, in the order of the record.
using SweepRuns = std::vector<std::pair<std::string, std::vector<std::string>>>;

SweepRuns sweep_runs_of(const StressRecord& record) {
  SweepRuns sweep_runs;
  for (const StressSweep& sweep : record.sweeps) {
    auto found =
        std::find_if(sweep_runs.begin(), sweep_runs.end(), [&](const auto& c) { return c.first == sweep.sweep_run; });
    if (found == sweep_runs.end()) {
      sweep_runs.push_back({sweep.sweep_run, {}});
      found = sweep_runs.end() - 1;
    }
    if (std::find(found->second.begin(), found->second.end(), sweep.feature) == found->second.end())
      found->second.push_back(sweep.feature);
  }
  return sweep_runs;
}

const StressSweep* sweep_of(const StressRecord& record, const std::string& feature, const std::string& sweep_run,
                            const std::string& engine) {
  for (const StressSweep& sweep : record.sweeps)
    if (sweep.feature == feature && sweep.sweep_run == sweep_run && sweep.engine == engine) return &sweep;
  return nullptr;
}

/// "15 (shape sphere of 40)", "6 (shape cube of 7; 4 silently wrong)".
std::string lowest_words(const StressRecord& record, const std::string& sweep_run,
                         const std::vector<std::string>& features, const std::string& engine) {
  std::size_t swept = 0, wrong = 0;
  const StressSweep* lowest = nullptr;
  for (const std::string& feature : features) {
    const StressSweep* sweep = sweep_of(record, feature, sweep_run, engine);
    if (sweep == nullptr || !sweep->not_swept.empty() || sweep->levels.empty()) continue;
    ++swept;
    if (sweep->breakdown() != nullptr) ++wrong;
    if (lowest == nullptr || ends_lower(*sweep, *lowest)) lowest = sweep;
  }
  if (lowest == nullptr) return "–";
  const std::string silent = wrong > 0 ? fmt::format("; {} silently wrong", wrong) : "";
  const std::optional<double> end = lowest->right_up_to();
  return fmt::format("{} ({} of {}{})", end ? fmt::format("{:g}", *end) : "none", lowest->feature, swept, silent);
}

}  // namespace

std::string stress_markdown(const StressRecord& record) {
  const std::vector<std::string> engines = engines_of(record);
  std::string text =
      fmt::format("`{}`, {:.0f} s on {}: {}.\n", record.command, record.seconds, record.host, stress_totals(record));
  text +=
      "\nA number is the largest k up to which every level is right; the outcome of the next level follows it. A sweep "
      "of many features shows the feature that ends lowest. A feature whose levels are all right ranks above the "
      "others.\n\n";
  text += head({"sweep"}, engines);
  const SweepRuns sweep_runs = sweep_runs_of(record);
  for (const auto& [sweep_run, features] : sweep_runs) {
    if (features.size() < many_features) continue;
    text += "| " + sweep_run + " |";
    for (const std::string& engine : engines) text += " " + lowest_words(record, sweep_run, features, engine) + " |";
    text += "\n";
  }
  text += "\n" + head({"feature", "sweep", "wanted"}, engines);
  for (const auto& [sweep_run, features] : sweep_runs) {
    if (features.size() >= many_features) continue;
    for (const std::string& feature : features) {
      std::string row;
      double wanted = -1;
      for (const std::string& engine : engines) {
        const StressSweep* sweep = sweep_of(record, feature, sweep_run, engine);
        row += sweep == nullptr || sweep->levels.empty() ? " – |" : " " + sweep_words(*sweep) + " |";
        if (sweep != nullptr) wanted = sweep->wanted;
      }
      text +=
          fmt::format("| {} | {} | {} |{}\n", feature, sweep_run, wanted < 0 ? "–" : fmt::format("{:g}", wanted), row);
    }
  }
  return text;
}

}  // namespace photonproof::reports::inline reports_stress
