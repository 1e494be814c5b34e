#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "reports/stress/stress_view.h"

namespace photonproof::reports::inline reports_stress {

namespace {

/// Climbs that a few features have are told apart by these.
constexpr const char* own_climb = "its own";

/// Lower is worse: whether and where pictures stop being right.
double end_of(const StressLadder& ladder) {
  const std::optional<double> right = ladder.right_up_to();
  if (right && ladder.rungs.back().outcome == RungOutcome::right) return 1e9;
  return right ? *right : -1e9;
}

std::string height_words(const ClimbSummary& summary) {
  if (summary.to_the_top) return "all";
  return summary.lowest ? fmt::format("{:g}", *summary.lowest) : "–";
}

}  // namespace

std::string ladder_words(const StressLadder& ladder) {
  if (!ladder.not_climbed.empty()) return "–";
  const std::optional<double> right = ladder.right_up_to();
  const std::string start = right ? fmt::format("{:g}", *right) : "";
  const auto next = std::find_if(ladder.rungs.begin(), ladder.rungs.end(),
                                 [](const StressRung& rung) { return rung.outcome != RungOutcome::right; });
  if (next == ladder.rungs.end()) return "all (" + start + ")";
  const StressRung* broken = ladder.breakdown();
  std::string text = start;
  if (broken == nullptr || next->height < broken->height)
    text += fmt::format("{}{} from {:g}", text.empty() ? "" : ", ", to_string(next->outcome), next->height);
  if (broken != nullptr)
    text += fmt::format("{}{} at {:g}", text.empty() ? "" : ", ", to_string(broken->outcome), broken->height);
  return text;
}

bool ends_lower(const StressLadder& a, const StressLadder& b) {
  return std::pair(end_of(a), a.right_up_to()) < std::pair(end_of(b), b.right_up_to());
}

std::vector<std::string> engines_of(const StressRecord& record) {
  std::vector<std::string> engines;
  for (const StressLadder& ladder : record.ladders)
    if (std::find(engines.begin(), engines.end(), ladder.engine) == engines.end()) engines.push_back(ladder.engine);
  return engines;
}

std::vector<ClimbSummary> summaries(const StressRecord& record) {
  std::map<std::string, std::set<std::string>> features;
  for (const StressLadder& ladder : record.ladders) features[ladder.climb].insert(ladder.feature);
  std::vector<ClimbSummary> all;
  for (const StressLadder& ladder : record.ladders) {
    if (!ladder.not_climbed.empty() || ladder.rungs.empty() || ladder.wanted < 0) continue;
    const std::string climb = features[ladder.climb].size() > 3 ? ladder.climb : own_climb;
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const ClimbSummary& s) { return s.climb == climb && s.engine == ladder.engine; });
    const bool is_first = found == all.end();
    if (is_first) {
      all.push_back({climb, ladder.engine, 0, {}, true, "", 0});
      found = all.end() - 1;
    }
    ++found->features;
    if (ladder.breakdown() != nullptr) ++found->wrong;
    const double end = end_of(ladder);
    if (end >= 1e9) continue;
    const double lowest = found->to_the_top ? 1e9 : found->lowest.value_or(-1e9);
    if (found->to_the_top || end < lowest) {
      found->lowest = ladder.right_up_to();
      found->feature = ladder.feature;
    }
    found->to_the_top = false;
  }
  return all;
}

std::string stress_totals(const StressRecord& record) {
  std::string text;
  for (const RungOutcome outcome : {RungOutcome::right, RungOutcome::degraded, RungOutcome::refused,
                                    RungOutcome::undecided, RungOutcome::silently_wrong, RungOutcome::crashed}) {
    const std::size_t n = record.count(outcome);
    const bool always = outcome == RungOutcome::right || outcome == RungOutcome::silently_wrong;
    if (n > 0 || always) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, to_string(outcome));
  }
  const auto left_out = std::count_if(record.ladders.begin(), record.ladders.end(),
                                      [](const StressLadder& ladder) { return !ladder.not_climbed.empty(); });
  if (left_out > 0) text += fmt::format("; {} of {} climbs left out", left_out, record.ladders.size());
  return text;
}

std::string stress_table(const StressRecord& record) {
  const std::vector<std::string> engines = engines_of(record);
  const std::string title = "right up to k of";
  std::size_t widest = title.size();
  std::vector<std::string> climbs;
  const std::vector<ClimbSummary> all = summaries(record);
  for (const ClimbSummary& s : all)
    if (s.climb != own_climb && std::find(climbs.begin(), climbs.end(), s.climb) == climbs.end()) {
      climbs.push_back(s.climb);
      widest = std::max(widest, s.climb.size());
    }
  std::string text = fmt::format("{:{}}", title, widest);
  for (const std::string& engine : engines) text += fmt::format(" {:>14}", engine);
  for (const std::string& climb : climbs) {
    text += fmt::format("\n{:{}}", climb, widest);
    for (const std::string& engine : engines) {
      const auto found = std::find_if(all.begin(), all.end(),
                                      [&](const ClimbSummary& s) { return s.climb == climb && s.engine == engine; });
      text += fmt::format(" {:>14}", found == all.end() ? "" : height_words(*found));
    }
  }
  text += "\n";
  for (const StressLadder& ladder : record.ladders)
    if (ladder.not_climbed.empty() && (ladder.breakdown() != nullptr || !ladder.reaches_wanted()))
      text += fmt::format("{}, {}, {}: {} (wanted {:g}; {})\n", ladder.feature, ladder.climb, ladder.engine,
                          ladder_words(ladder), ladder.wanted, ladder.rungs.back().sentence);
  return text + stress_totals(record) + "\n";
}

}  // namespace photonproof::reports::inline reports_stress
