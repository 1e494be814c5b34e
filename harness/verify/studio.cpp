#include "harness/verify/studio.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/cells/cell_command.h"
#include "harness/cells/cells.h"
#include "harness/cells/host.h"
#include "harness/cells/run_cell.h"
#include "harness/pixels/image_blocks.h"
#include "harness/statistics/radiance_range.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/engine_stats.h"
#include "harness/verify/picture_pair.h"
#include "scenes/images/mean_error.h"
#include "scenes/text/size_text.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

constexpr double biased_mean = 0.01, biased_block = 0.1;
constexpr int pictures_without_variance = 8;  // of an engine that says nothing of its noise
constexpr std::uint64_t seeds_of_a_series = 1000;

/// The image's own variance, or none.
bool has_noise_layer(const Rendering& rendering) { return rendering.variance.has_value(); }

/// An engine's own variance may be from few batches of it.
bool is_of_few_batches(const Rendering& rendering) { return rendering.metadata.contains("photonproof:batches"); }

/// Pixels' variances from few pictures, none less certain than its block is on the whole.
void steady_by_blocks(Image& variance) {
  const Image raw = variance;
  for (const Block& block : blocks_of(raw.width, raw.height))
    for (std::size_t c = 0; c < 3; ++c) {
      double mean = 0;
      for_each_pixel(block, [&](int x, int y) { mean += double{raw.pixel(x, y)[c]} / block.pixels(); });
      for_each_pixel(block, [&](int x, int y) {
        variance.pixel(x, y)[c] = std::max(raw.pixel(x, y)[c], static_cast<float>(mean));
      });
    }
}

/// Weighed by their samples.
Rendering pooled(const std::vector<std::pair<Rendering, double>>& parts) {
  const Image& first = parts.front().first.mean;
  Rendering out;
  out.mean = Image(first.width, first.height);
  out.variance = Image(first.width, first.height);
  double total = 0;
  for (const auto& [part, samples] : parts) total += samples;
  const bool layers = std::ranges::all_of(parts, [](const auto& part) { return has_noise_layer(part.first); });
  for (std::size_t i = 0; i < out.mean.rgb.size(); ++i) {
    double mean = 0, variance = 0;
    for (const auto& [part, samples] : parts) {
      const double weight = samples / total;
      mean += weight * double{part.mean.rgb[i]};
      if (layers) variance += weight * weight * double{part.variance->rgb[i]};
    }
    if (!layers && parts.size() > 1)
      for (const auto& [part, samples] : parts)
        variance += std::pow(double{part.mean.rgb[i]} - mean, 2) / double(parts.size() * (parts.size() - 1));
    out.mean.rgb[i] = static_cast<float>(mean);
    out.variance->rgb[i] = static_cast<float>(variance);
  }
  if (!layers || std::ranges::any_of(parts, [](const auto& part) { return is_of_few_batches(part.first); }))
    steady_by_blocks(*out.variance);
  store_pixels_a_splat(out, pixels_a_splat(parts.front().first));
  MeanError error;
  error.passes = 0;
  for (const auto& [part, samples] : parts) {
    const auto stored = stored_mean_error(part);
    if (!stored) return out;
    for (std::size_t c = 0; c < 3; ++c)
      error.standard_error[c] += std::pow(samples / total * stored->standard_error[c], 2);
    error.passes += stored->passes;
  }
  for (double& e : error.standard_error) e = std::sqrt(e);
  store_mean_error(out, error);
  return out;
}

/// The next picture's samples, a power of two, so that a run that goes on asks for the same; 0: enough, or no time.
double next_samples(double had, double seen, double power, double spent, double allowed) {
  if (seen <= power || spent >= allowed) return 0;
  const double needed = had * std::pow(seen / power, 2) * 1.1 - had;
  const double wanted = std::min(needed, 15 * had);
  const double rate = spent / had, left = allowed - spent;
  const double affordable = rate > 0 ? left / rate : wanted;
  double next = std::exp2(std::ceil(std::log2(std::max(1.0, wanted))));
  while (next > affordable) next /= 2;
  return next >= had / 4 ? next : 0;
}

/// What is asked for, or what POV-Ray was found to need of the scene.
double quality_of(const StudioScene& scene, const VerifyEngine& engine, double asked) {
  const bool is_measured = engine.row.name == "povray" && scene.expect && scene.expect->povray;
  return is_measured ? std::max<double>(asked, scene.expect->povray->quality) : asked;
}

double stated_bias(const Result& result) {
  const auto found = result.counts.find("relative_bias");
  return found == result.counts.end() ? 0 : found->second;
}

/// Our programs end with 2 where they cannot render a scene, and say why.
bool is_refusal(const Result& result, const VerifyEngine& engine) {
  return result.status == Status::unsupported ||
         (engine.is_ours && result.status == Status::crash && result.detail.starts_with("exited with 2"));
}

}  // namespace

DeclaredError declared_error(const VerifyEngine& engine, const std::optional<Expect>& expect, double stated_bias) {
  if (engine.row.trust == Trust::unbiased) return {};
  DeclaredError declared{std::max(biased_mean, stated_bias), std::max(biased_block, 2 * stated_bias), ""};
  declared.reason = stated_bias > biased_mean ? "as its stats say" : "as of every biased engine";
  if (!expect) return declared;
  for (const Tolerance& tolerance : expect->tolerances) {
    if (tolerance.engine != engine.row.name || tolerance.metric != "bias") continue;
    declared.whole = tolerance.value;
    declared.block = tolerance.block.value_or(std::max(biased_block, 2 * tolerance.value));
    declared.reason = tolerance.reason;
  }
  return declared;
}

Studio::Studio(StudioOptions options) : options_(std::move(options)), store_(options_.folder) {
  if (options_.threads == 0) options_.threads = describe_host().cores;
}

Result Studio::cell(const StudioScene& scene, const VerifyEngine& engine, const Budget& budget,
                    std::uint64_t seed) const {
  SuiteCommon suite;
  suite.folder = options_.rows.empty() ? fs::path(".") : fs::absolute(options_.rows).parent_path();
  suite.limits.threads = options_.threads;
  suite.limits.seconds = 4 * options_.seconds + 120;
  suite.limits.memory_mb = 4096;
  suite.engines = {engine.row};
  SuiteScene row;
  row.name = scene.name;
  row.path = scene.file;
  row.given_path = scene.file.string();
  row.width = scene.width;
  row.height = scene.height;
  suite.scenes = {row};
  const Cell cell{scene.name, engine.row.name, budget, seed};
  const std::string key = content_key({{"verify", "1"},
                                       {"scene", scene.content},
                                       {"engine", length_prefixed(engine.row.command)},
                                       {"version", engine.version.line},
                                       {"budget", budget.label()},
                                       {"seed", std::to_string(seed)},
                                       {"size", size_text(scene.width, scene.height)},
                                       {"seconds", std::to_string(suite.limits.seconds)}});
  // What was killed or could not be started may do better now.
  if (auto found = store_.latest(key);
      found && (found->kept.result.status == Status::ok || found->kept.result.status == Status::unsupported))
    return found->kept.result;
  if (options_.at_work) options_.at_work(cell.label());
  const std::string folder = store_.make_folder(key);
  const CellCommand command =
      cell_command(suite, cell, options_.program, options_.folder / folder, "image", options_.threads, nullptr);
  std::optional<Result> result = run_cell(cell_run(cell, command, row, suite.limits, options_.interrupt));
  if (!result || (options_.interrupt != nullptr && *options_.interrupt)) throw VerifyInterrupted();
  result->key = key;
  result->engine_version = engine.version.line;
  if (result->status == Status::ok) result->image = folder + "/" + command.image.filename().string();
  store_.keep(folder, {*result, ""});
  return *result;
}

Shot Studio::shoot_samples(const StudioScene& scene, const VerifyEngine& engine, int series) const {
  std::vector<std::pair<Rendering, double>> parts;
  Shot shot;
  EnginePicture picture;
  picture.engine = engine.row.name;
  double samples = options_.first_samples;  // of the next picture
  double spent = 0, bias = 0;               // so far; as the engine states it
  std::uint64_t seed = 1 + static_cast<std::uint64_t>(series) * seeds_of_a_series;
  const bool takes_seed = mentions(engine.row.command, "{seed}");
  const auto of_engine = [&](const char* kind) { return engine.budget_kind == kind; };
  const double amount = of_engine("quality") ? quality_of(scene, engine, options_.quality) : 1;
  while (samples > 0) {
    const Budget budget{engine.budget_kind, engine.counts_samples() ? samples : amount};
    const Result result = cell(scene, engine, budget, seed++);
    if (result.status != Status::ok) {
      if (parts.empty() || result.status != Status::timeout)
        return {std::nullopt, is_refusal(result, engine) ? Status::unsupported : result.status, result.detail,
                result.command};
      break;  // too slow for more
    }
    const fs::path image = options_.folder / result.image;
    parts.emplace_back(read_rendering(image.string()), samples);
    if (const std::string why = why_variance_is_lost(parts.back().first.mean); !why.empty())
      return {std::nullopt, Status::unsupported, "its picture " + why, result.command};
    EngineStats stats = read_engine_stats(image.parent_path() / "stats.json");
    picture.losses = std::move(stats.losses);
    picture.cannot_find = std::move(stats.cannot_find);
    bias = std::max(bias, stated_bias(result));
    shot.command = result.command;
    picture.seconds += result.wall_seconds.value_or(0);
    // By processor time, so that a busy machine asks for the same pictures.
    spent += result.cpu_seconds.value_or(0) / options_.threads;
    if (!takes_seed || !engine.counts_samples()) break;
    if (!has_noise_layer(parts.front().first) && parts.size() < pictures_without_variance) continue;
    picture.rendering = pooled(parts);
    double had = 0;
    for (const auto& part : parts) had += part.second;
    const double next = next_samples(had, would_see_alone(picture).value_or(0), options_.power / std::sqrt(2.0), spent,
                                     options_.seconds);
    if (!has_noise_layer(parts.front().first) && next > 0) break;  // its pictures are of one size
    samples = next;
  }
  picture.rendering = pooled(parts);
  double had = 0;
  for (const auto& part : parts) had += part.second;
  picture.samples = engine.counts_samples() ? static_cast<std::uint64_t>(had) : 0;
  picture.declared = declared_error(engine, scene.expect, bias);
  shot.picture = std::move(picture);
  return shot;
}

Shot Studio::shoot(const StudioScene& scene, const VerifyEngine& engine, int series) const {
  if (engine.version.problem) return {std::nullopt, engine.version.cells_end_as, *engine.version.problem, ""};
  if (scene.expect)
    if (const auto why = scene.expect->unsupported.find(engine.row.name); why != scene.expect->unsupported.end())
      return {std::nullopt, Status::unsupported, why->second, ""};
  if (scene.description != nullptr)
    if (const std::string why = what_is_not_shown(engine.sampling, *scene.description); !why.empty())
      return {std::nullopt, Status::unsupported, why, ""};
  return shoot_samples(scene, engine, series);
}

}  // namespace photonproof
