#include "reports/view/conclusions.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/record/gate_metrics.h"
#include "reports/view/numbers.h"
#include "reports/view/verdicts.h"
#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {

std::string estimate_text(const Estimate& estimate, int digits) {
  std::string text = significant(estimate.value, digits);
  if (estimate.interval) {
    text += fmt::format(" [{}, {}]", significant(estimate.interval->low, digits),
                        significant(estimate.interval->high, digits));
  }
  return text;
}

std::string estimate_text(const std::optional<Estimate>& estimate, int digits) {
  return or_dash(estimate, [&](const Estimate& e) { return estimate_text(e, digits); });
}

std::string estimate_text(const std::optional<Estimate>& estimate, const Reasons& undefined, const char* name) {
  const auto why = undefined.find(name);
  if (estimate || why == undefined.end()) return estimate_text(estimate);
  return fmt::format("{} ({})", undefined_number, why->second);
}

std::string why_no_interval(const ConvergencePoint& point) {
  const auto why = point.undefined.find("relmse_interval");
  return why == point.undefined.end() ? "" : " (" + why->second + ")";
}

PlainTable points_table(const std::vector<const Convergence*>& curves, const std::string& mark) {
  const Clock clock = curves.empty() ? Clock::wall : curves.front()->clock;
  PlainTable table{{"Engine", "Budget", "Seeds", "Verdict", clock == Clock::wall ? "Median wall s" : "Median CPU s",
                    "relMSE", "bias²", "variance"},
                   {}};
  for (const Convergence* curve : curves) {
    for (const ConvergencePoint& point : curve->points) {
      table.rows.push_back({curve->engine, budget_text(point.budget), std::to_string(point.seeds),
                            or_dash(point.correctness, verdict_text), estimate_text(point.seconds),
                            estimate_text(point.relmse) + mark + why_no_interval(point),
                            estimate_text(point.bias2, point.undefined, "bias2"),
                            estimate_text(point.variance, point.undefined, "variance")});
    }
  }
  return table;
}

std::string time_text(const TargetTime& target) {
  if (target.more_than) return "> " + significant(*target.more_than);
  if (target.at_most) return "≤ " + significant(*target.at_most);
  if (!target.undefined.empty()) return fmt::format("{} ({})", undefined_number, target.undefined);
  return estimate_text(target.seconds);
}

PlainTable slopes_table(const std::vector<const Convergence*>& curves) {
  const Clock clock = curves.empty() ? Clock::wall : curves.front()->clock;
  PlainTable table{
      {"Engine", "Slope", "Efficiency 1/s", "Target relMSE", clock == Clock::wall ? "s to target" : "CPU s to target"},
      {}};
  for (const Convergence* curve : curves) {
    const Reasons& undefined = curve->undefined;
    const std::string slope = estimate_text(curve->slope, undefined, "slope");
    const std::string efficiency = estimate_text(curve->efficiency, undefined, "efficiency");
    if (curve->targets.empty())
      table.rows.push_back({curve->engine, slope, efficiency, undefined_number, undefined_number});
    for (const TargetTime& target : curve->targets)
      table.rows.push_back({curve->engine, slope, efficiency, significant(target.relmse), time_text(target)});
  }
  return table;
}

PlainTable gates_table(const std::vector<const GateRecord*>& gates) {
  PlainTable table{{"Verdict", "Gate", "Engine", "Metric", "Observed", "Bound", "Samples", "Looks", "α", "s"}, {}};
  for (const GateRecord* gate : gates) {
    table.rows.push_back({to_string(gate->verdict), gate->name, gate->engine, gate->metric,
                          estimate_text(gate->observed), or_dash(gate->bound, [](double v) { return significant(v); }),
                          gate->samples > 0 ? grouped(static_cast<double>(gate->samples)) : undefined_number,
                          std::to_string(gate->looks), significant(gate->alpha, 2), significant(gate->seconds)});
  }
  return table;
}

std::string beyond_noise(const GateRecord& gate, const FailingTile& tile) {
  if (!weighs_noise(gate.metric)) return "";
  return ", " + significant(tile.score) + " standard errors beyond noise";
}

PlainTable changes_table(const std::vector<const ChangeRecord*>& changes) {
  PlainTable table{{"Change", "Scene", "Engine", "Budget", "Of", "New / old", "A/A control", "In words"}, {}};
  for (const ChangeRecord* change : changes) {
    const auto interval = [](const Interval& i) {
      return fmt::format("[{}, {}]", significant(i.low), significant(i.high));
    };
    table.rows.push_back({to_string(change->change), change->scene, change->engine, budget_text(change->budget),
                          change->quantity, estimate_text(change->ratio), or_dash(change->control, interval),
                          change->sentence});
  }
  return table;
}

std::vector<std::string> skips_texts(const std::vector<const Result*>& cells,
                                     const std::vector<const GateRecord*>& gates) {
  std::vector<std::string> texts;
  const auto add = [&](const std::string& engine, const std::vector<std::string>& skips) {
    for (const std::string& skip : skips) {
      const std::string text = engine + ": " + skip;
      if (std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
    }
  };
  for (const Result* cell : cells) add(cell->cell.engine, cell->skipped);
  for (const GateRecord* gate : gates) add(gate->engine, gate->skipped);
  return texts;
}

}  // namespace photonproof::reports::inline reports_view
