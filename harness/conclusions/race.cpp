#include "harness/conclusions/race.h"

#include <algorithm>
#include <map>
#include <string>

#include "harness/conclusions/convergence.h"

namespace photonproof {
namespace {

/// An error that grows with the budget by more than this is not known.
constexpr double tolerated_growth = 2;

double least_error(const CurvePoints& points) {
  return std::min_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->second;
}

/// Seconds and error, ascending seconds.
CurvePoints points_of(const Convergence& curve) {
  CurvePoints points;
  for (const CurvePoint& point : curve.points)
    if (point.relmse && point.relmse->value > 0 && point.seconds.value > 0 && !point.undefined.contains(own_error_key))
      points.emplace_back(point.seconds.value, point.relmse->value);
  // Small budgets that met none of the rare bright samples look better than they are. In the order of budgets: times of
  // a busy machine may have another.
  if (!points.empty() && points.back().second > tolerated_growth * least_error(points)) return {};
  std::sort(points.begin(), points.end());
  return points;
}

RaceRecord::Time time_of(const std::string& engine, const CurvePoints& points, double error) {
  if (points.front().second <= error) return {engine, points.front().first, true};
  return {engine, *time_to_error(points, error), false};
}

}  // namespace

std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves) {
  struct Runner {
    std::string engine;
    CurvePoints points;
  };
  std::vector<std::string> scenes;
  std::map<std::string, std::vector<Runner>> runners;
  for (const Convergence& curve : curves) {
    CurvePoints points = points_of(curve);
    if (points.empty()) continue;
    if (!runners.contains(curve.scene)) scenes.push_back(curve.scene);
    runners[curve.scene].push_back({curve.engine, std::move(points)});
  }
  std::vector<RaceRecord> races;
  for (const std::string& scene : scenes) {
    RaceRecord race{scene, 0, {}};
    for (const Runner& runner : runners[scene]) race.relmse = std::max(race.relmse, least_error(runner.points));
    for (const Runner& runner : runners[scene]) {
      const RaceRecord::Time time = time_of(runner.engine, runner.points, race.relmse);
      const auto same = std::find_if(race.times.begin(), race.times.end(),
                                     [&](const RaceRecord::Time& other) { return other.engine == time.engine; });
      if (same == race.times.end())
        race.times.push_back(time);
      else if (time.seconds < same->seconds)
        *same = time;
    }
    std::stable_sort(race.times.begin(), race.times.end(),
                     [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
    if (race.times.size() > 1) races.push_back(std::move(race));
  }
  return races;
}

}  // namespace photonproof
