#include "harness/conclusions/race.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "harness/conclusions/convergence.h"

namespace photonproof::inline harness_conclusions {
namespace {

using Time = RaceRecord::Time;

bool is_value(const Time& time) { return !time.at_most && !time.more_than; }
double least(const Time& time) { return time.at_most ? 0 : time.seconds; }
double most(const Time& time) { return time.more_than ? std::numeric_limits<double>::infinity() : time.seconds; }

bool order_is_known(const Time& a, const Time& b) {
  return (is_value(a) && is_value(b)) || most(a) <= least(b) || most(b) <= least(a);
}

struct Runner {
  std::string engine;
  KnownPoints points;
};

std::vector<Time> times_to(double relmse, const std::vector<Runner>& runners) {
  std::vector<Time> times;
  for (const Runner& runner : runners) {
    const TargetTime target = time_to_target(runner.points, relmse);
    const Time time{runner.engine,
                    target.seconds ? target.seconds->value : target.at_most.value_or(target.more_than.value_or(0)),
                    target.at_most.has_value(), target.more_than.has_value()};
    const auto same = std::ranges::find(times, time.engine, &Time::engine);
    if (same == times.end())
      times.push_back(time);
    else if (std::pair(most(time), time.seconds) < std::pair(most(*same), same->seconds))
      *same = time;
  }
  return times;
}

struct Score {
  std::size_t values = 0, known_orders = 0;
  auto operator<=>(const Score&) const = default;
};

Score score_of(const std::vector<Time>& times) {
  Score score;
  for (std::size_t i = 0; i < times.size(); ++i) {
    score.values += is_value(times[i]);
    for (std::size_t j = 0; j < i; ++j) score.known_orders += order_is_known(times[i], times[j]);
  }
  return score;
}

void rank(std::vector<Time>& times) {
  for (Time& time : times)
    time.unranked = !is_value(time) && !std::ranges::all_of(times, [&](const Time& other) {
      return &other == &time || order_is_known(time, other);
    });
  std::ranges::stable_sort(times, {}, [](const Time& t) { return std::pair(t.unranked, t.seconds); });
}

}  // namespace

std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves) {
  std::vector<std::pair<std::string, std::vector<Runner>>> scenes;
  for (const Convergence& curve : curves) {
    KnownPoints points = known_points(curve);
    if (points.points.empty()) continue;
    auto scene = std::ranges::find(scenes, curve.scene, [](const auto& entry) { return entry.first; });
    if (scene == scenes.end()) scene = scenes.insert(scenes.end(), {curve.scene, {}});
    scene->second.push_back({curve.engine, std::move(points)});
  }
  std::vector<RaceRecord> races;
  for (const auto& [scene, runners] : scenes) {
    std::vector<double> errors;
    for (const Runner& runner : runners) errors.push_back(runner.points.points.back()->relmse->value);
    std::ranges::sort(errors);
    RaceRecord race{scene, 0, {}};
    Score best;
    for (const double error : errors) {
      std::vector<Time> times = times_to(error, runners);
      const Score score = score_of(times);
      if (score.known_orders == 0 || score <= best) continue;
      best = score;
      race.relmse = error;
      race.times = std::move(times);
    }
    if (race.times.empty()) continue;
    rank(race.times);
    races.push_back(std::move(race));
  }
  return races;
}

}  // namespace photonproof::inline harness_conclusions
