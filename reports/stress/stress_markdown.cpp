#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reports/stress/stress_view.h"

namespace photonproof::reports::inline reports_stress {
namespace {

/// What many features climb is told by the lowest of them; the rest a row each.
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
using Climbs = std::vector<std::pair<std::string, std::vector<std::string>>>;

Climbs climbs_of(const StressRecord& record) {
  Climbs climbs;
  for (const StressLadder& ladder : record.ladders) {
    auto found = std::find_if(climbs.begin(), climbs.end(), [&](const auto& c) { return c.first == ladder.climb; });
    if (found == climbs.end()) {
      climbs.push_back({ladder.climb, {}});
      found = climbs.end() - 1;
    }
    if (std::find(found->second.begin(), found->second.end(), ladder.feature) == found->second.end())
      found->second.push_back(ladder.feature);
  }
  return climbs;
}

const StressLadder* ladder_of(const StressRecord& record, const std::string& feature, const std::string& climb,
                              const std::string& engine) {
  for (const StressLadder& ladder : record.ladders)
    if (ladder.feature == feature && ladder.climb == climb && ladder.engine == engine) return &ladder;
  return nullptr;
}

/// "15 (shape sphere of 40)", "6 (shape cube of 7; 4 silently wrong)".
std::string lowest_words(const StressRecord& record, const std::string& climb, const std::vector<std::string>& features,
                         const std::string& engine) {
  std::size_t climbed = 0, wrong = 0;
  const StressLadder* lowest = nullptr;
  for (const std::string& feature : features) {
    const StressLadder* ladder = ladder_of(record, feature, climb, engine);
    if (ladder == nullptr || !ladder->not_climbed.empty() || ladder->rungs.empty()) continue;
    ++climbed;
    if (ladder->breakdown() != nullptr) ++wrong;
    if (lowest == nullptr || ends_lower(*ladder, *lowest)) lowest = ladder;
  }
  if (lowest == nullptr) return "–";
  const std::string silent = wrong > 0 ? fmt::format("; {} silently wrong", wrong) : "";
  const std::optional<double> end = lowest->right_up_to();
  return fmt::format("{} ({} of {}{})", end ? fmt::format("{:g}", *end) : "none", lowest->feature, climbed, silent);
}

}  // namespace

std::string stress_markdown(const StressRecord& record) {
  const std::vector<std::string> engines = engines_of(record);
  std::string text =
      fmt::format("`{}`, {:.0f} s on {}: {}.\n", record.command, record.seconds, record.host, stress_totals(record));
  text +=
      "\nA number is the k up to which every rung is right; behind it what comes next. What many features climb is "
      "told by the one that ends lowest; one whose rungs are all right ends above the others.\n\n";
  text += head({"climb"}, engines);
  const Climbs climbs = climbs_of(record);
  for (const auto& [climb, features] : climbs) {
    if (features.size() < many_features) continue;
    text += "| " + climb + " |";
    for (const std::string& engine : engines) text += " " + lowest_words(record, climb, features, engine) + " |";
    text += "\n";
  }
  text += "\n" + head({"feature", "climb", "wanted"}, engines);
  for (const auto& [climb, features] : climbs) {
    if (features.size() >= many_features) continue;
    for (const std::string& feature : features) {
      std::string row;
      double wanted = -1;
      for (const std::string& engine : engines) {
        const StressLadder* ladder = ladder_of(record, feature, climb, engine);
        row += ladder == nullptr || ladder->rungs.empty() ? " – |" : " " + ladder_words(*ladder) + " |";
        if (ladder != nullptr) wanted = ladder->wanted;
      }
      text += fmt::format("| {} | {} | {} |{}\n", feature, climb, wanted < 0 ? "–" : fmt::format("{:g}", wanted), row);
    }
  }
  return text;
}

}  // namespace photonproof::reports::inline reports_stress
