#include "harness/verify/engine_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "harness/cells/host.h"
#include "harness/statistics/pooled_pictures.h"
#include "harness/statistics/radiance_range.h"
#include "harness/suites/engine_command.h"
#include "harness/verify/picture_pair.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

constexpr double biased_mean = 0.01, biased_block = 0.1;
constexpr int pictures_without_variance = 8;  // for an engine without variance
constexpr std::uint64_t seeds_of_a_series = 1000;

/// Samples of the next picture, a power of two, so that a resumed run needs the same pictures; 0: enough, or no time.
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

/// The requested quality, or POV-Ray's measured need for the scene if that is higher.
double quality_of(const RenderedScene& scene, const VerifyEngine& engine, double asked) {
  const bool is_measured = engine.row.name == "povray" && scene.expect && scene.expect->povray;
  return is_measured ? std::max<double>(asked, scene.expect->povray->quality) : asked;
}

double stated_bias(const Result& result) {
  const auto found = result.counts.find("relative_bias");
  return found == result.counts.end() ? 0 : found->second;
}

/// Our programs exit with 2 and a reason if they cannot render a scene.
bool is_refusal(const Result& result, const VerifyEngine& engine) {
  return result.status == Status::unsupported || (engine.is_ours && exited_with(result, 2));
}

/// The losses that the engine declared, with the scene's own path in place of the copy's.
std::vector<std::string> losses_of(const Result& result) {
  std::vector<std::string> losses;
  for (const std::string& caveat : result.caveats)
    if (caveat.starts_with(declared_by_engine)) losses.push_back(caveat.substr(std::strlen(declared_by_engine)));
  return losses;
}

ImageSourceOptions source_options(const EngineRendererOptions& options) {
  ImageSourceOptions source{.use = ImageUse::estimate, .folder = options.folder, .program = options.program};
  source.suite_folder = options.rows.empty() ? fs::path(".") : fs::absolute(options.rows).parent_path();
  source.limits.threads = options.threads;
  source.limits.seconds = 4 * options.seconds + 120;
  source.limits.memory_mb = 4096;
  // A killed process, or one that could not start, may succeed now.
  source.reused = {Status::ok, Status::unsupported};
  source.interrupt = options.interrupt;
  if (options.at_work) source.starts = [at_work = options.at_work](const Cell& cell) { at_work(cell.label()); };
  return source;
}

EngineRendererOptions with_threads(EngineRendererOptions options) {
  if (options.threads == 0) options.threads = describe_host().cores;
  return options;
}

double samples_of(const std::vector<PictureOfSamples>& parts) {
  double sum = 0;
  for (const PictureOfSamples& part : parts) sum += part.samples;
  return sum;
}

}  // namespace

EnginePicture pooled_picture(const std::vector<PictureOfSamples>& parts) {
  PooledPicture pooled = pool_pictures(parts);
  EnginePicture picture;
  picture.rendering = std::move(pooled.rendering);
  picture.images = std::move(pooled.images);
  return picture;
}

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

EngineRenderer::EngineRenderer(EngineRendererOptions options)
    : options_(with_threads(std::move(options))), source_(source_options(options_)), copies_(options_.folder) {}

KeptImage EngineRenderer::image(const RenderedScene& scene, const VerifyEngine& engine, const Budget& budget,
                                std::uint64_t seed) const {
  SuiteScene row;
  row.name = scene.name;
  row.path = scene.file;
  row.width = scene.width;
  row.height = scene.height;
  SceneCopies* copies = scene.has_answers ? &copies_ : nullptr;
  std::optional<KeptImage> image =
      source_.draw({&engine.row, engine.version.line}, {&row, scene.content, scene.crop, copies}, budget, seed);
  if (!image || (options_.interrupt != nullptr && *options_.interrupt)) throw VerifyInterrupted();
  return *std::move(image);
}

EngineRender EngineRenderer::render_samples(const RenderedScene& scene, const VerifyEngine& engine, int series) const {
  std::vector<PictureOfSamples> parts;
  EngineRender render;
  EnginePicture picture;
  picture.engine = engine.row.name;
  double samples = options_.first_samples;  // of the next picture
  double spent = 0, bias = 0;               // spent so far; bias stated by the engine
  std::uint64_t seed = 1 + static_cast<std::uint64_t>(series) * seeds_of_a_series;
  const bool takes_seed = mentions(engine.row.command, "{seed}");
  const auto of_engine = [&](const char* kind) { return engine.budget_kind == kind; };
  const double amount = of_engine("quality") ? quality_of(scene, engine, options_.quality) : 1;
  while (samples > 0) {
    const Budget budget{engine.budget_kind, engine.counts_samples() ? samples : amount};
    const KeptImage drawn = image(scene, engine, budget, seed++);
    const Result& result = drawn.kept.result;
    if (result.status != Status::ok) {
      if (parts.empty() || result.status != Status::timeout)
        return {std::nullopt, is_refusal(result, engine) ? Status::unsupported : result.status, result.detail,
                result.command};
      break;  // too slow for more samples
    }
    parts.push_back({source_.image_of(result), samples});
    if (const std::string why = why_variance_is_lost(parts.back().rendering.mean); !why.empty())
      return {std::nullopt, Status::unsupported, "its picture " + why, result.command};
    EngineStats stats = source_.stats_of(drawn);
    picture.losses = losses_of(result);
    picture.cannot_find = std::move(stats.cannot_find);
    bias = std::max(bias, stated_bias(result));
    render.command = result.command;
    picture.seconds += result.wall_seconds.value_or(0);
    // Processor time, so that a busy machine gives the same pictures.
    spent += result.cpu_seconds.value_or(0) / options_.threads;
    if (!takes_seed || !engine.counts_samples()) break;
    const bool knows_its_noise = parts.front().rendering.variance.has_value();
    if (!knows_its_noise && parts.size() < pictures_without_variance) continue;
    const EnginePicture so_far = pooled_picture(parts);
    const double had = samples_of(parts);
    const double next = next_samples(had, would_see_alone(so_far).value_or(0), options_.power / std::sqrt(2.0), spent,
                                     options_.seconds);
    if (!knows_its_noise && next > 0) break;  // its pictures have one size
    samples = next;
  }
  EnginePicture pooled = pooled_picture(parts);
  picture.rendering = std::move(pooled.rendering);
  if (takes_seed && engine.counts_samples()) picture.images = std::move(pooled.images);
  const double had = samples_of(parts);
  picture.samples = engine.counts_samples() ? static_cast<std::uint64_t>(had) : 0;
  picture.declared = declared_error(engine, scene.expect, bias);
  render.picture = std::move(picture);
  return render;
}

EngineRender EngineRenderer::render(const RenderedScene& scene, const VerifyEngine& engine, int series) const {
  if (engine.version.problem) return {std::nullopt, engine.version.cells_end_as, *engine.version.problem, ""};
  if (scene.expect)
    if (const auto why = scene.expect->unsupported.find(engine.row.name); why != scene.expect->unsupported.end())
      return {std::nullopt, Status::unsupported, why->second, ""};
  if (scene.description != nullptr)
    if (const std::string why = what_is_not_shown(engine.sampling, *scene.description); !why.empty())
      return {std::nullopt, Status::unsupported, why, ""};
  return render_samples(scene, engine, series);
}

}  // namespace photonproof::inline harness_verify
