#include "harness/conclusions/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "harness/conclusions/error_curve.h"

namespace photonproof::inline harness_conclusions {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// The least error of a race that no target asks for: .1 % of a pixel, which nobody sees.
constexpr double least_error = 1e-6;

struct Runner {
  std::string engine;
  KnownPoints points;
  const ConvergencePoint& first() const { return *points.points.front(); }
  const ConvergencePoint& last() const { return *points.points.back(); }
};

// One engine's time to an error. `least` and `most` bound it with the confidence of the intervals, as far as they are
// known.
struct Entry {
  RaceRecord::Time time;
  double least = 0, most = infinity;
  bool is_value() const { return !time.at_most && !time.more_than; }
};

bool order_is_known(const Entry& a, const Entry& b) {
  return (a.is_value() && b.is_value()) || a.most <= b.least || b.most <= a.least;
}

std::pair<double, double> ends_of(double value, const std::optional<Interval>& interval) {
  return interval ? std::pair(interval->low, interval->high) : std::pair(value, value);
}

// A bound holds only if the interval of the budget's error lies on its side of `relmse`.
Entry entry_of(const Runner& runner, double relmse) {
  const TargetTime target = time_to_target(runner.points, relmse);
  Entry entry{{.engine = runner.engine}};
  if (target.seconds) {
    entry.time.seconds = target.seconds->value;
    entry.time.interval = target.seconds->interval;
    std::tie(entry.least, entry.most) = ends_of(target.seconds->value, target.seconds->interval);
  } else if (target.at_most) {
    const ConvergencePoint& first = runner.first();
    entry.time.seconds = *target.at_most;
    entry.time.at_most = true;
    if (ends_of(first.relmse->value, relmse_interval(first)).second <= relmse)
      entry.most = ends_of(*target.at_most, first.seconds.interval).second;
  } else {
    const ConvergencePoint& last = runner.last();
    entry.time.seconds = target.more_than.value_or(0);
    entry.time.more_than = true;
    if (ends_of(last.relmse->value, relmse_interval(last)).first > relmse)
      entry.least = ends_of(entry.time.seconds, last.seconds.interval).first;
  }
  return entry;
}

std::vector<Entry> entries_at(double relmse, const std::vector<Runner>& runners) {
  std::vector<Entry> entries;
  for (const Runner& runner : runners) {
    Entry entry = entry_of(runner, relmse);
    const auto same = std::ranges::find(entries, entry.time.engine, [](const Entry& e) { return e.time.engine; });
    const auto most = [](const Entry& e) { return e.time.more_than ? infinity : e.time.seconds; };
    if (same == entries.end())
      entries.push_back(std::move(entry));
    else if (std::pair(most(entry), entry.time.seconds) < std::pair(most(*same), same->time.seconds))
      *same = std::move(entry);
  }
  return entries;
}

// An interval where both are known, added in quadrature on the logarithm.
Estimate ratio_of(double value, const std::optional<Interval>& interval, double to,
                  const std::optional<Interval>& interval_of_to) {
  Estimate ratio{value / to, {}};
  if (!interval || !interval_of_to || interval->low <= 0 || interval_of_to->low <= 0) return ratio;
  const double down = std::hypot(std::log(value / interval->low), std::log(interval_of_to->high / to));
  const double up = std::hypot(std::log(interval->high / value), std::log(to / interval_of_to->low));
  ratio.interval = Interval{ratio.value * std::exp(-down), ratio.value * std::exp(up)};
  return ratio;
}

void set_ratio(Entry& entry, const Entry& first) {
  if (entry.is_value() && first.is_value()) {
    entry.time.ratio = ratio_of(entry.time.seconds, entry.time.interval, first.time.seconds, first.time.interval);
  } else {
    entry.time.ratio = Estimate{entry.least / first.most, {}};
    entry.time.at_least = true;
  }
}

// The fastest, to which ratios are taken. A bound leads only where it is below every value. Among bounds alone, the one
// that settles most orders leads.
const Entry& leader_of(const std::vector<Entry>& entries) {
  const auto rank = [&](const Entry& entry) {
    const auto leaves_open = [&](const Entry& other) { return &other != &entry && !order_is_known(entry, other); };
    const auto may_be_slower_than = [&](const Entry& other) { return other.is_value() && leaves_open(other); };
    const bool behind = entry.time.more_than || std::ranges::any_of(entries, may_be_slower_than);
    const auto open = std::ranges::any_of(entries, &Entry::is_value) ? 0 : std::ranges::count_if(entries, leaves_open);
    return std::tuple(behind, open, entry.time.seconds);
  };
  return *std::ranges::min_element(entries, {}, rank);
}

std::vector<RaceRecord::Time> ranked(std::vector<Entry> entries) {
  const Entry leader = leader_of(entries);
  const auto leads = [&](const Entry& e) { return e.time.engine == leader.time.engine; };
  for (Entry& entry : entries)
    if (!leads(entry) && order_is_known(entry, leader))
      set_ratio(entry, leader);
    else
      entry.time.unranked = !leads(entry);
  std::ranges::stable_sort(entries, {},
                           [&](const Entry& e) { return std::tuple(e.time.unranked, !leads(e), e.time.seconds); });
  std::vector<RaceRecord::Time> times;
  for (Entry& entry : entries) times.push_back(std::move(entry.time));
  return times;
}

bool is_value(const RaceRecord::Time& time) { return !time.at_most && !time.more_than; }

// How much a race at an error tells. Larger is better.
struct Score {
  bool first_is_a_value = false;
  std::size_t with_interval = 0, ratios = 0;
  auto operator<=>(const Score&) const = default;
};

Score score_of(const std::vector<RaceRecord::Time>& times) {
  Score score{is_value(times.front()), 0, 0};
  for (const RaceRecord::Time& time : times) {
    score.ratios += time.ratio.has_value();
    score.with_interval += time.ratio && time.ratio->interval;
  }
  return score;
}

// 1, 2 and 5 times powers of ten from `least` to `most`, ascending.
std::vector<double> round_numbers(double least, double most) {
  std::vector<double> numbers;
  for (int power = static_cast<int>(std::floor(std::log10(least))); power <= std::log10(most); ++power)
    for (const int digit : {1, 2, 5}) {
      // Decimal text gives the double that a reader's "0.001" is.
      const double number = std::stod(fmt::format("{}e{}", digit, power));
      if (number >= least && number <= most) numbers.push_back(number);
    }
  return numbers;
}

RaceRecord race_at(double relmse, const std::vector<Runner>& runners) {
  RaceRecord race;
  race.relmse = relmse;
  race.times = ranked(entries_at(relmse, runners));
  return race;
}

bool is_judged(const RaceRecord& race) {
  return std::ranges::any_of(race.times, [](const RaceRecord::Time& time) { return time.ratio.has_value(); });
}

// "path 0.2 to 0.1", or one number for an error that budgets hardly change.
std::string errors_text(const Runner& runner) {
  const double first = runner.first().relmse->value, last = runner.last().relmse->value;
  constexpr double same = 1.05;
  return std::abs(std::log(first / last)) < std::log(same)
             ? fmt::format("{} {:.2g}", runner.engine, last)
             : fmt::format("{} {:.2g} to {:.2g}", runner.engine, first, last);
}

std::string why_undecided(const std::vector<Runner>& runners) {
  std::string text;
  for (const Runner& runner : runners) text += (text.empty() ? "" : ", ") + errors_text(runner);
  return "the measured errors decide no order: " + text;
}

// The best race at a round error, or at an engine's own where the fastest time to no round one is known.
RaceRecord best_race(const std::vector<Runner>& runners) {
  std::vector<double> own;
  for (const Runner& runner : runners)
    for (const ConvergencePoint* point : runner.points.points)
      own.push_back(std::max(point->relmse->value, least_error));
  const auto [least, most] = std::ranges::minmax(own);
  RaceRecord best;
  std::vector<double> round = round_numbers(least, most);
  std::erase_if(round, [&](double error) { return std::ranges::find(own, error) != own.end(); });
  for (const auto& errors : {round, own}) {
    for (const double error : errors) {
      RaceRecord race = race_at(error, runners);
      if (is_judged(race) && (best.times.empty() || score_of(race.times) > score_of(best.times)))
        best = std::move(race);
    }
    if (!best.times.empty() && is_value(best.times.front())) return best;
  }
  if (best.times.empty()) best.undecided = why_undecided(runners);
  return best;
}

std::vector<RaceRecord::Error> errors_at(double seconds, const std::vector<Runner>& runners) {
  std::vector<RaceRecord::Error> errors;
  for (const Runner& runner : runners) {
    const std::optional<Estimate> error = error_at_time(runner.points, seconds);
    if (!error) continue;
    const auto same = std::ranges::find(errors, runner.engine, &RaceRecord::Error::engine);
    if (same == errors.end())
      errors.push_back({runner.engine, *error, {}});
    else if (error->value < same->relmse.value)
      same->relmse = *error;
  }
  std::ranges::stable_sort(errors, {}, [](const RaceRecord::Error& error) { return error.relmse.value; });
  for (std::size_t i = 1; i < errors.size(); ++i)
    errors[i].ratio =
        ratio_of(errors[i].relmse.value, errors[i].relmse.interval, errors[0].relmse.value, errors[0].relmse.interval);
  return errors;
}

void set_errors(RaceRecord& race, const std::vector<Runner>& runners) {
  double least = infinity, most = 0;
  for (const Runner& runner : runners) {
    least = std::min(least, runner.first().seconds.value);
    most = std::max(most, runner.last().seconds.value);
  }
  for (const double seconds : round_numbers(least, most)) {
    std::vector<RaceRecord::Error> errors = errors_at(seconds, runners);
    if (errors.size() < 2 || errors.size() < race.errors.size()) continue;
    race.seconds = seconds;
    race.errors = std::move(errors);
  }
}

// An engine without known errors takes no part, and the reason is given if it leaves one engine alone.
RaceRecord race_of_too_few(const std::vector<const Convergence*>& curves) {
  RaceRecord race;
  for (const Convergence* curve : curves) {
    const KnownPoints known = known_points(*curve);
    if (!known.points.empty()) continue;
    race.undecided +=
        (race.undecided.empty() ? "" : "; ") + curve->engine + ": " + (known.leap.empty() ? no_own_error : known.leap);
  }
  return race;
}

std::vector<RaceRecord> races_of_scene(const std::vector<const Convergence*>& curves) {
  std::vector<Runner> runners;
  std::vector<double> targets;
  std::vector<std::string> engines, known_engines;
  const auto add_once = [](auto& list, const auto& item) {
    if (std::ranges::find(list, item) == list.end()) list.push_back(item);
  };
  for (const Convergence* curve : curves) {
    add_once(engines, curve->engine);
    for (const TargetTime& target : curve->targets) add_once(targets, target.relmse);
    KnownPoints points = known_points(*curve);
    if (points.points.empty()) continue;
    add_once(known_engines, curve->engine);
    runners.push_back({curve->engine, std::move(points)});
  }
  if (engines.size() < 2) return {};
  std::vector<RaceRecord> races;
  if (known_engines.size() < 2) {
    races = {race_of_too_few(curves)};
  } else if (targets.empty()) {
    races = {best_race(runners)};
  } else {
    for (const double target : targets) {
      RaceRecord& race = races.emplace_back(race_at(target, runners));
      race.is_target = true;
      if (is_judged(race)) continue;
      race.times.clear();
      race.undecided = fmt::format("no two engines' budgets show their order at relMSE {:.2g}", target);
    }
  }
  for (RaceRecord& race : races) {
    race.scene = curves.front()->scene;
    if (known_engines.size() > 1) set_errors(race, runners);
  }
  return races;
}

}  // namespace

std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves) {
  std::vector<std::vector<const Convergence*>> scenes;
  for (const Convergence& curve : curves) {
    const auto same = std::ranges::find(scenes, curve.scene, [](const auto& scene) { return scene.front()->scene; });
    if (same == scenes.end())
      scenes.push_back({&curve});
    else
      same->push_back(&curve);
  }
  std::vector<RaceRecord> races;
  for (const auto& scene : scenes)
    for (RaceRecord& race : races_of_scene(scene)) races.push_back(std::move(race));
  return races;
}

}  // namespace photonproof::inline harness_conclusions
