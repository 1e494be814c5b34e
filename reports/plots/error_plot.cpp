#include "reports/plots/error_plot.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "reports/view/conclusions.h"
#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_plots {
namespace {

bool drawable(const std::optional<double>& value) { return value && std::isfinite(*value) && *value > 0; }

/// The part of an interval that fits on a logarithmic axis.
std::optional<Interval> drawable_part(const std::optional<Interval>& interval, double value) {
  if (!interval || !drawable(interval->high)) return std::nullopt;
  return Interval{drawable(interval->low) ? interval->low : value / 100, interval->high};
}

ErrorPlot plot_of_curves(const View& view, const SceneView& scene) {
  ErrorPlot plot;
  for (const Convergence* curve : scene.curves) {
    plot.clock = curve->clock;
    plot.targets.clear();
    for (const TargetTime& target : curve->targets)
      if (drawable(target.relmse)) plot.targets.push_back(target.relmse);
    PlotSeries series{engine_index(view, curve->engine), {}};
    if (curve->slope) series.slope = curve->slope->value;
    for (const ConvergencePoint& point : curve->points) {
      if (!drawable(point.seconds.value) || !point.relmse || !drawable(point.relmse->value)) {
        ++plot.left_out;
        continue;
      }
      plot.over_seeds = plot.over_seeds || point.seeds > 1;
      series.points.push_back(
          {point.seconds.value, point.relmse->value, drawable_part(point.seconds.interval, point.seconds.value),
           drawable_part(point.relmse->interval, point.relmse->value),
           fmt::format("{}, {}, {} seed{}: relMSE {} in {} s", curve->engine, budget_text(point.budget), point.seeds,
                       point.seeds == 1 ? "" : "s", estimate_text(*point.relmse), estimate_text(point.seconds))});
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

ErrorPlot plot_of_cells(const SceneView& scene) {
  ErrorPlot plot;
  for (const EngineOutcome& outcome : scene.engines) {
    std::map<std::uint64_t, PlotSeries> by_seed;
    for (const Result* cell : outcome.cells) {
      if (cell->status != Status::ok) continue;
      const auto relmse = metric(*cell, "relmse");
      if (drawable(cell->wall_seconds) && drawable(relmse)) {
        by_seed[cell->cell.seed].points.push_back(
            {*cell->wall_seconds,
             *relmse,
             {},
             {},
             fmt::format("{}, {}, seed {}: relMSE {} in {} s", cell->cell.engine, budget_text(cell->cell.budget),
                         cell->cell.seed, significant(*relmse), significant(*cell->wall_seconds))});
      } else {
        ++plot.left_out;
      }
    }
    for (auto& [seed, series] : by_seed) {
      series.engine = outcome.engine;
      plot.series.push_back(std::move(series));
    }
  }
  return plot;
}

}  // namespace

ErrorPlot error_plot(const View& view, const SceneView& scene) {
  ErrorPlot curves = plot_of_curves(view, scene);
  return curves.series.empty() ? plot_of_cells(scene) : curves;
}

}  // namespace photonproof::reports::inline reports_plots
