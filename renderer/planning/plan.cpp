#include "renderer/planning/plan.h"

#include <algorithm>

#include "renderer/planning/plan_words.h"

namespace photonproof::inline renderer_planning {

bool RenderPlan::skips(Skip skip) const {
  return std::any_of(decisions.begin(), decisions.end(),
                     [&](const Decision& d) { return d.skip == skip && d.skipped; });
}

std::vector<std::string> RenderPlan::skipped() const {
  std::vector<std::string> lines;
  for (const Decision& d : decisions)
    if (d.skipped) lines.push_back(std::string(skip_row(d.skip).name) + ": " + d.why);
  return lines;
}

std::string plan_text(const RenderPlan& plan) {
  const auto line = [](const std::string& name, const std::string& text) {
    return "  " + name + std::string(name.size() < 20 ? 20 - name.size() : 1, ' ') + text + "\n";
  };
  std::string text = plan.integrator + ", kernels " + plan.isa + " (" + counted(plan.lanes, "lane", "lanes") + ")\n";
  text += "runs\n";
  for (const PlanStep& step : plan.runs) text += line(step.what, step.how);
  if (plan.lost_light) text += line("cannot find", plan.lost_light->text());
  for (const bool skipped : {true, false}) {
    const auto listed = [&](const RenderPlan::Decision& d) { return d.skipped == skipped; };
    if (std::none_of(plan.decisions.begin(), plan.decisions.end(), listed)) continue;
    text += skipped ? "skips\n" : "does not skip\n";
    for (const RenderPlan::Decision& d : plan.decisions)
      if (listed(d)) text += line(skip_row(d.skip).name, skip_row(d.skip).what + (": " + d.why));
  }
  return text;
}

}  // namespace photonproof::inline renderer_planning
