#include "harness/conclusions/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/conclusions/error_curve.h"
#include "harness/conclusions/error_split.h"
#include "harness/pixels/repeated_images.h"
#include "harness/statistics/statistics.h"
#include "scenes/base/input_error.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_conclusions {
namespace {

namespace fs = std::filesystem;

// An error counts as the reference's too if the reference's noise is more than this share of it.
constexpr double tolerated_reference_share = 0.1;
// An error counts as the reference's alone if the reference's noise is more than this share of it.
constexpr double foreign_reference_share = 0.5;
// Relative deviations of 1e-5 are rounding (deviations.h), so a relmse of their square is no error.
constexpr double rounding_relmse = 1e-10;
// A slope known less well than to +-1 does not show whether a method converges.
constexpr double useful_slope_margin = 1;
constexpr std::size_t least_points_for_slope = 3;
// A curve shows start-up time if rendering takes less than this share of its time.
constexpr double least_rendering_share = 0.5;

struct Reference {
  Rendering rendering;
  ReferenceVariance known = ReferenceVariance::upper_bound;
  double relative_variance = 0;
};

std::optional<Rendering> read_if_there(const fs::path& file) {
  try {
    return read_stored(file.string());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::optional<Reference> reference_of(const Results& results, const SceneRecord& scene, const fs::path& folder) {
  const Result* result = results.find(scene.reference_label);
  const std::string file = scene.reference ? scene.reference->image : result != nullptr ? result->image : "";
  if (file.empty()) return std::nullopt;
  std::optional<Rendering> rendering = read_if_there(folder / file);
  if (!rendering) return std::nullopt;
  // A stored reference has its variance from independent batches.
  Reference reference{std::move(*rendering),
                      scene.reference ? ReferenceVariance::exact : ReferenceVariance::upper_bound};
  if (reference.rendering.variance)
    reference.relative_variance = relative_variance(reference.rendering.mean, *reference.rendering.variance);
  return reference;
}

using Cells = std::vector<const Result*>;

// Rendering's share of the wall time, from the engine's phases; empty where the engine reports none.
std::optional<double> rendering_share(const Cells& cells) {
  std::vector<double> shares;
  for (const Result* cell : cells) {
    double sum = 0;
    for (const auto& [phase, seconds] : cell->phases)
      if (phase != "load" && phase != "write") sum += seconds;
    if (!cell->phases.empty() && cell->wall_seconds.value_or(0) > 0) shares.push_back(sum / *cell->wall_seconds);
  }
  return shares.empty() ? std::nullopt : std::optional(median_of(shares));
}

// The estimate of bias^2 is unbiased: without a bias it is negative as often as positive, and only its interval's upper
// end means much.
void set_split(const ErrorSplit& split, ConvergencePoint& point) {
  point.relmse = split.relmse;
  point.variance = split.variance;
  const std::string of_few = fmt::format("one pixel has {:.0f} % of the error", 100 * split.share_of_a_pixel);
  if (split.is_of_few_pixels()) point.undefined[interval_key] = of_few;
  if (!split.bias2) {
    point.undefined["bias2"] = point.undefined["variance"] = point.seeds == 1 ? "one seed" : "one image for all seeds";
  } else if (split.is_of_few_pixels()) {
    point.undefined["bias2"] = of_few;
  } else if (const auto& interval = split.bias2->interval; interval && interval->low <= 0) {
    point.undefined["bias2"] = fmt::format("none seen above {:.2g}", std::max(0.0, interval->high));
  } else {
    point.bias2 = split.bias2;
  }
}

// The images without exact copies, since a copy adds nothing to what is known of the noise.
std::vector<Image> different_ones(const std::vector<Image>& images) {
  std::vector<Image> different;
  for (const Image& image : images)
    if (std::ranges::none_of(different, [&](const Image& other) { return bytes_of(other) == bytes_of(image); }))
      different.push_back(image);
  return different;
}

// relmse of the cells, copies once; empty where one is not known.
std::vector<double> errors_of(const Cells& cells) {
  std::vector<double> errors;
  for (const Result* cell : cells) {
    const std::optional<double> error = relmse_of(*cell);
    if (!error) return {};
    if (std::ranges::find(errors, *error) == errors.end()) errors.push_back(*error);
  }
  return errors;
}

void add_error(const Cells& cells, const Reference* reference, const fs::path& folder, const JudgeImages& judge,
               ConvergencePoint& point) {
  std::vector<Image> images;
  for (const Result* cell : cells) {
    std::optional<Rendering> image = reference == nullptr ? std::nullopt : read_if_there(folder / cell->image);
    if (image && image->mean.rgb.size() == reference->rendering.mean.rgb.size())
      images.push_back(std::move(image->mean));
  }
  if (images.size() == cells.size()) {
    const auto& variance = reference->rendering.variance;
    const std::vector<Image> different = different_ones(images);
    set_split(split_error(reference->rendering.mean, variance ? &*variance : nullptr, different, reference->known),
              point);
    if (const auto errors = errors_of(cells); !point.relmse->interval && errors.size() > 1)
      point.spread_of_seeds = estimated_mean(errors).interval;
    // Images that are all the same may still be right; the judge decides that.
    if (judge) point.correctness = judge(cells.front()->cell, different.size() > 1 ? different : images);
    return;
  }
  if (judge) point.correctness = judge(cells.front()->cell, {});
  point.undefined["bias2"] = point.undefined["variance"] =
      reference == nullptr ? "no reference" : "an image is missing";
  if (const auto errors = errors_of(cells); !errors.empty()) point.relmse = estimated_mean(errors);
}

void add_reference_share(const Reference* reference, ConvergencePoint& point, Convergence& curve) {
  if (!point.relmse) return;
  if (point.relmse->value <= rounding_relmse) point.undefined[own_error_key] = "it is rounding";
  if (reference == nullptr) return;
  const double share = reference->relative_variance / point.relmse->value;
  if (share > foreign_reference_share) point.undefined.try_emplace(own_error_key, "it is the reference's noise");
  if (share > tolerated_reference_share)
    curve.caveats.push_back(fmt::format("{}: {} of the error is the reference's own noise", point.budget.label(),
                                        share < 1 ? fmt::format("{:.0f} %", 100 * share) : "all"));
}

void add_point(const Budget& budget, const Cells& cells, const Reference* reference, const fs::path& folder,
               const JudgeImages& judge, Convergence& curve) {
  ConvergencePoint point;
  point.budget = budget;
  point.seeds = static_cast<int>(cells.size());
  std::vector<double> seconds;
  for (const Result* cell : cells) seconds.push_back(seconds_by(curve.clock, *cell).value_or(0));
  point.seconds = estimated_time(seconds);
  add_error(cells, reference, folder, judge, point);
  for (const std::size_t i : outliers_of(seconds))
    curve.caveats.push_back(fmt::format("{}: seed {} took {:.3g} s, the median {:.3g} s: an outlier", budget.label(),
                                        cells[i]->cell.seed, seconds[i], point.seconds.value));
  add_reference_share(reference, point, curve);
  curve.points.push_back(std::move(point));
}

bool is_reference(const Results& results, const Result& result) {
  return std::any_of(results.scenes.begin(), results.scenes.end(),
                     [&](const SceneRecord& scene) { return scene.reference_label == result.cell.label(); });
}

// Finished cells of one scene, engine and kind of budget, by ascending budget.
std::map<double, Cells> cells_by_amount(const Results& results, const Cell& like) {
  std::map<double, Cells> cells;
  for (const Result& result : results.results)
    if (result.status == Status::ok && result.cell.scene == like.scene && result.cell.engine == like.engine &&
        result.cell.budget.kind == like.budget.kind && !is_reference(results, result))
      cells[result.cell.budget.amount].push_back(&result);
  return cells;
}

// Takes the text of the first image of the largest budget, since numbers in the texts differ between images.
void add_declared_losses(const std::map<double, Cells>& cells, Convergence& curve) {
  for (const std::string& caveat : cells.rbegin()->second.front()->caveats)
    if (caveat.starts_with(declared_by_engine)) curve.caveats.push_back(caveat);
}

// Names the largest budget concerned; the smaller ones are concerned too.
void add_start_up_caveat(const std::map<double, Cells>& cells, Convergence& curve) {
  for (auto budget = cells.rbegin(); budget != cells.rend(); ++budget) {
    const std::optional<double> share = rendering_share(budget->second);
    if (!share || *share >= least_rendering_share) continue;
    curve.caveats.push_back(fmt::format("up to {} most of the time is start-up (at that budget {:.0f} % is rendering)",
                                        budget->second.front()->cell.budget.label(), 100 * *share));
    return;
  }
}

std::string why_no_error(const ConvergencePoint& point) {
  const auto why = point.undefined.find(own_error_key);
  return why != point.undefined.end() ? "error: " + why->second
         : point.relmse               ? "no error or no time"
                                      : "no error known";
}

void set_slope(const KnownPoints& known, Convergence& curve) {
  const std::size_t budgets = known.points.size();
  if (budgets < least_points_for_slope) {
    curve.undefined["slope"] = !known.leap.empty() ? known.leap
                               : budgets == 0      ? no_own_error
                               : budgets == 1      ? "one budget"
                                                   : "two budgets";
    return;
  }
  const auto fit = fit_in_logarithms(known);
  if (!fit) {
    curve.undefined["slope"] = "budgets take the same time";
    return;
  }
  const double margin = (fit->slope_interval->high - fit->slope_interval->low) / 2;
  if (margin > useful_slope_margin)
    curve.undefined["slope"] = fmt::format("known to \u00b1{:.2g} only", margin);
  else
    curve.slope = Estimate{fit->slope, fit->slope_interval};
}

// Relative half-widths add in quadrature on the logarithm. Without an interval of both there is none.
Estimate efficiency_of(const Estimate& relmse, const Estimate& seconds) {
  Estimate efficiency{1 / (relmse.value * seconds.value), {}};
  double down = 0, up = 0;
  for (const Estimate& part : {relmse, seconds}) {
    if (!part.interval || part.interval->low <= 0) return efficiency;
    down = std::hypot(down, std::log(part.interval->high / part.value));
    up = std::hypot(up, std::log(part.value / part.interval->low));
  }
  efficiency.interval = Interval{efficiency.value * std::exp(-down), efficiency.value * std::exp(up)};
  return efficiency;
}

}  // namespace

std::optional<double> relmse_of(const Result& result) {
  for (const MetricValue& metric : result.metrics)
    if (metric.name == "relmse") return metric.value;
  return std::nullopt;
}

void conclude(Convergence& curve) {
  const KnownPoints known = known_points(curve);
  set_slope(known, curve);
  if (!curve.points.empty()) {
    const ConvergencePoint& last = curve.points.back();
    if (!has_own_error(last))
      curve.undefined["efficiency"] = why_no_error(last);
    else if (known.points.empty())
      curve.undefined["efficiency"] = known.leap;
    else
      curve.efficiency = efficiency_of(*last.relmse, last.seconds);
  }
  for (TargetTime& target : curve.targets) target = time_to_target(known, target.relmse);
  if (!known.leap.empty())
    curve.caveats.push_back(known.leap + ": the smaller budgets met too few rare bright samples, or it is a fault");
  const auto few = [](const ConvergencePoint& point) { return point.seeds < 2; };
  if (std::any_of(curve.points.begin(), curve.points.end(), few))
    curve.caveats.push_back("one seed: neither spread nor bias is known");
}

std::vector<Convergence> convergence_of(const Results& results, const fs::path& folder,
                                        const ErrorTargets& target_relmse, const JudgeImages& judge, Clock clock) {
  std::vector<Convergence> curves;
  for (const SceneRecord& scene : results.scenes) {
    const std::optional<Reference> reference = reference_of(results, scene, folder);
    std::vector<std::string> seen;
    for (const Result& result : results.results) {
      const std::string group = result.cell.engine + "\n" + result.cell.budget.kind;
      if (result.cell.scene != scene.name || std::find(seen.begin(), seen.end(), group) != seen.end()) continue;
      const std::map<double, Cells> cells = cells_by_amount(results, result.cell);
      if (cells.empty()) continue;
      seen.push_back(group);
      Convergence curve;
      curve.scene = scene.name;
      curve.engine = result.cell.engine;
      curve.clock = clock;
      if (const auto targets = target_relmse.find(scene.name); targets != target_relmse.end())
        for (const double target : targets->second) curve.targets.push_back({target});
      for (const auto& [amount, seeds] : cells)
        add_point(seeds.front()->cell.budget, seeds, reference ? &*reference : nullptr, folder, judge, curve);
      add_start_up_caveat(cells, curve);
      add_declared_losses(cells, curve);
      conclude(curve);
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace photonproof::inline harness_conclusions
