#include "reports/view/races.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/view/numbers.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_view {
namespace {

using Time = RaceRecord::Time;

/// Ratios keep two digits; beyond 100 whole numbers.
std::string ratio_text(double ratio) { return ratio >= 100 ? grouped(std::round(ratio)) : significant(ratio, 2); }

std::string seconds_text(const Time& time) {
  return (time.at_most ? "≤ " : time.more_than ? "> " : "") + significant(time.seconds, 2) + " s";
}

bool is_slower(const Time& time) {
  if (!time.ratio) return false;
  return time.at_least ? time.ratio->value > 1 : time.ratio->interval && time.ratio->interval->low > 1;
}

bool is_larger(const RaceRecord::Error& error) {
  return error.ratio && error.ratio->interval && error.ratio->interval->low > 1;
}

const RaceTable::Cell no_cell{undefined_number, "", false, false};

RaceTable table_of_engines(const View& view) {
  RaceTable table;
  for (const std::size_t engine : view.compared) table.engines.push_back(view.engines[engine].name);
  return table;
}

std::string clause(const Time& time) {
  if (time.unranked) return fmt::format("{} needs {}, which leaves the order open", time.engine, seconds_text(time));
  if (!time.ratio) return fmt::format("{} needs {}", time.engine, seconds_text(time));  // in older records
  if (is_slower(time) || !time.ratio->interval)
    return fmt::format("{} sooner than {}", times_text(*time.ratio, time.at_least), time.engine);
  return fmt::format("as soon as {} within noise ({} its time)", time.engine, times_text(*time.ratio));
}

std::string scenes_text(std::size_t count) { return fmt::format("{} scene{}", count, count == 1 ? "" : "s"); }

/// Scenes that one engine wins, and the range of its leads over the second.
struct Wins {
  std::string engine;
  std::size_t scenes = 0;
  double least = 0, most = 0;
  bool open_end = false;                         ///< a lead is known from below only
  std::size_t right = 0, biased = 0, noisy = 0;  ///< of the scenes; the others have no verdict
  SeenBias largest_bias{};
};

/// The verdict on the engine's images of the largest budget; null if there is none.
const CorrectnessRecord* verdict_on(const View& view, const std::string& scene_name, const std::string& engine) {
  for (const SceneView& scene : view.scenes)
    for (const EngineOutcome& outcome : scene.engines)
      if (scene.record.name == scene_name && view.engines[outcome.engine].name == engine && outcome.shown != nullptr)
        return correctness_of(scene, outcome.shown->cell);
  return nullptr;
}

void add_win(const View& view, const RaceRecord& race, std::vector<Wins>& all) {
  const std::string& engine = race.times.front().engine;
  auto wins = std::ranges::find(all, engine, &Wins::engine);
  if (wins == all.end()) wins = all.insert(all.end(), {.engine = engine});
  const Time& second = race.times[1];
  const double low = second.at_least ? second.ratio->value : second.ratio->interval->low;
  const double high = second.at_least ? second.ratio->value : second.ratio->interval->high;
  wins->least = wins->scenes == 0 ? low : std::min(wins->least, low);
  wins->most = std::max(wins->most, high);
  wins->open_end |= second.at_least;
  ++wins->scenes;
  const CorrectnessRecord* verdict = verdict_on(view, race.scene, engine);
  if (verdict == nullptr) return;
  wins->right += verdict->verdict == Correctness::right;
  wins->noisy += verdict->verdict == Correctness::noisy;
  wins->biased += verdict->verdict == Correctness::biased;
  if (const auto bias = seen_bias(*verdict); bias && bias->size >= wins->largest_bias.size) wins->largest_bias = *bias;
}

/// ". Where pm wins, it is right on 1, biased on 2 by up to 1.9 % of a block's light, too noisy to judge on 1". Empty
/// for an engine that is right on all, or without verdicts.
std::string but_not_right(const Wins& wins) {
  if (wins.biased + wins.noisy == 0) return {};
  std::vector<std::string> parts;
  if (wins.right > 0) parts.push_back(fmt::format("right on {}", wins.right));
  if (wins.biased > 0) parts.push_back(fmt::format("biased on {}", wins.biased));
  if (wins.largest_bias.size > 0)
    parts.back() += fmt::format(" by {}{}", wins.biased > 1 ? "up to " : "", bias_text(wins.largest_bias));
  if (wins.noisy > 0) parts.push_back(fmt::format("too noisy to judge on {}", wins.noisy));
  return fmt::format(". Where {} wins, it is {}", wins.engine, fmt::join(parts, ", "));
}

/// "2.0 to 11 times", or "2.0 to more than 11 times" where a lead is known from below only.
std::string lead_text(const Wins& wins) {
  if (!wins.open_end) return times_text({wins.least, Interval{wins.least, wins.most}});
  const std::string least = ratio_text(wins.least), most = ratio_text(wins.most);
  return least == most ? "at least " + least + " times" : least + " to more than " + most + " times";
}

}  // namespace

std::string times_text(const Estimate& ratio, bool at_least) {
  if (at_least) return "at least " + ratio_text(ratio.value) + " times";
  if (!ratio.interval) return "about " + ratio_text(ratio.value) + " times";
  const std::string low = ratio_text(ratio.interval->low), high = ratio_text(ratio.interval->high);
  return low == high ? low + " times" : low + " to " + high + " times";
}

bool has_winner(const RaceRecord& race) {
  const auto ranked = std::ranges::count(race.times, false, &Time::unranked);
  return ranked > 1 && std::ranges::all_of(race.times.begin() + 1, race.times.begin() + ranked, is_slower);
}

std::string race_text(const RaceRecord& race) {
  if (race.times.empty()) return fmt::format("{} is not judged: {}", race.scene, race.undecided);
  std::string text =
      fmt::format("{} reaches relMSE {} on {}", race.times.front().engine, significant(race.relmse, 2), race.scene);
  for (const Time& time : race.times)
    if (&time != &race.times.front())
      text += (!time.ratio ? "; " : &time == &race.times[1] ? " " : ", ") + clause(time);
  return text;
}

std::string races_sentence(const View& view) {
  std::vector<Wins> all;
  std::size_t ties = 0, unjudged = 0;
  for (const RaceRecord* race : view.races) {
    if (has_winner(*race))
      add_win(view, *race, all);
    else
      ++(race->times.empty() ? unjudged : ties);
  }
  if (view.races.empty()) return {};
  std::ranges::stable_sort(all, std::greater{}, &Wins::scenes);
  std::string text, doubts;
  for (const Wins& wins : all) {
    text += text.empty() ? fmt::format("{} is fastest to the same error on {} of {}, {} sooner than the next",
                                       wins.engine, wins.scenes, scenes_text(view.races.size()), lead_text(wins))
                         : fmt::format("; {} on {}, {}", wins.engine, wins.scenes, lead_text(wins));
    doubts += but_not_right(wins);
  }
  if (text.empty())
    return "No engine is known to be faster on " +
           (view.races.size() == 1 ? "the one scene" : fmt::format("any of {} scenes", view.races.size()));
  if (ties > 0) text += fmt::format("; {} without a winner", ties);
  if (unjudged > 0) text += fmt::format("; {} not judged", unjudged);
  return text + doubts;
}

std::string error_lead_text(const RaceRecord& race) {
  if (race.errors.size() < 2 || !is_larger(race.errors[1])) return {};
  return race.errors[0].engine + ": " + times_text(*race.errors[1].ratio) + " less";
}

RaceTable race_table(const View& view) {
  RaceTable table = table_of_engines(view);
  for (const RaceRecord* race : view.races) {
    RaceTable::Row row{race->scene, significant(race->relmse, 2), {}, race->undecided, error_lead_text(*race)};
    const bool won = has_winner(*race);
    for (const std::string& engine : table.engines) {
      RaceTable::Cell& cell = row.cells.emplace_back(no_cell);
      const auto time = std::ranges::find(race->times, engine, &Time::engine);
      if (time == race->times.end()) continue;
      cell = {seconds_text(*time), time->ratio ? times_text(*time->ratio, time->at_least) : "",
              won && time == race->times.begin(), time->at_least};
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

RaceTable error_table(const View& view) {
  RaceTable table = table_of_engines(view);
  for (const RaceRecord* race : view.races) {
    if (race->errors.empty() || std::ranges::count(table.rows, race->scene, &RaceTable::Row::scene) > 0) continue;
    RaceTable::Row row{race->scene, significant(race->seconds, 2) + " s", {}, ""};
    const bool won = std::ranges::all_of(race->errors.begin() + 1, race->errors.end(), is_larger);
    for (const std::string& engine : table.engines) {
      RaceTable::Cell& cell = row.cells.emplace_back(no_cell);
      const auto error = std::ranges::find(race->errors, engine, &RaceRecord::Error::engine);
      if (error == race->errors.end()) continue;
      cell = {significant(error->relmse.value, 2), error->ratio ? times_text(*error->ratio) : "",
              won && error == race->errors.begin()};
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace photonproof::reports::inline reports_view
