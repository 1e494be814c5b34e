#include "reports/error_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/engine_style.h"
#include "reports/numbers.h"

namespace photonproof::reports {
namespace {

bool drawable(const std::optional<double>& value) { return value && std::isfinite(*value) && *value > 0; }

std::string axis_commands(const char* name, const LogAxis& axis) {
  std::string ticks;
  for (const double tick : axis.ticks) {
    ticks += fmt::format("{}'{}' {:.17g}", ticks.empty() ? "" : ", ", significant(tick, 1), tick);
  }
  return fmt::format("set {0}range [{1:.17g}:{2:.17g}]\nset {0}tics ({3})\n", name, axis.low, axis.high, ticks);
}

}  // namespace

ErrorPlot error_plot(const SceneView& scene) {
  ErrorPlot plot;
  for (const EngineOutcome& outcome : scene.engines) {
    std::map<std::uint64_t, PlotSeries> by_seed;
    for (const Result* cell : outcome.cells) {
      if (cell->status != Status::ok) continue;
      const auto relmse = metric(*cell, "relmse");
      if (drawable(cell->wall_seconds) && drawable(relmse)) {
        by_seed[cell->cell.seed].points.push_back({*cell->wall_seconds, *relmse});
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

LogAxis log_axis(double smallest, double largest) {
  constexpr double margin = 0.06;  // of the axis, on either side of the data
  double low = std::log10(smallest), high = std::log10(largest);
  const double widen = std::max(0.0, std::log10(4.0) - (high - low)) / 2;
  low -= widen + margin * (high - low);
  high += widen + margin * (high - low);
  LogAxis axis{std::pow(10.0, low), std::pow(10.0, high), {}};
  const double decades = high - low;
  std::vector<int> mantissas{1};
  if (decades < 1.3) {
    mantissas = {1, 2, 3, 5, 7};
  } else if (decades < 3) {
    mantissas = {1, 2, 5};
  }
  const int step = std::max(1, static_cast<int>(std::ceil(decades / 9)));
  for (int exponent = static_cast<int>(std::floor(low)); exponent <= static_cast<int>(std::ceil(high)); ++exponent) {
    if (exponent % step != 0) continue;
    for (const int mantissa : mantissas) {
      const double tick = mantissa * std::pow(10.0, exponent);
      if (tick >= axis.low && tick <= axis.high) axis.ticks.push_back(tick);
    }
  }
  return axis;
}

std::string gnuplot_script(const ErrorPlot& plot) {
  PlotPoint low = plot.series.front().points.front(), high = low;
  std::string data, curves;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    data += fmt::format("$series{} << END\n", i);
    for (const PlotPoint& point : plot.series[i].points) {
      low = {std::min(low.seconds, point.seconds), std::min(low.relmse, point.relmse)};
      high = {std::max(high.seconds, point.seconds), std::max(high.relmse, point.relmse)};
      data += fmt::format("{:.17g} {:.17g}\n", point.seconds, point.relmse);
    }
    data += "END\n";
    const EngineStyle style = engine_style(plot.series[i].engine);
    curves += fmt::format("{}$series{} using 1:2 with linespoints lt 1 lw 2 pt {} ps 1 lc rgb '{}'",
                          i == 0 ? "plot " : ", \\\n     ", i, style.gnuplot_point, style.color);
  }
  return R"(set terminal svg size 560,380 noenhanced font 'sans-serif,15'
set encoding utf8
set logscale xy
set grid xtics ytics lt 1 lw 1 lc rgb '#e2e4e6'
set border 3 lt 1 lw 1 lc rgb '#8a9096'
set tics nomirror out scale 0.5 textcolor rgb '#3d4248'
set xlabel 'wall-clock seconds' textcolor rgb '#3d4248'
set ylabel 'relMSE' textcolor rgb '#3d4248'
unset key
)" + axis_commands("x", log_axis(low.seconds, high.seconds)) +
         axis_commands("y", log_axis(low.relmse, high.relmse)) + data + curves + "\n";
}

}  // namespace photonproof::reports
