#include "harness/references/reference_run.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "harness/images/executor.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/splitmix.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_references {
namespace {

namespace fs = std::filesystem;

// A batch that is killed or out of time loses at most this much.
constexpr double checkpoint_seconds = 20;
constexpr int trial_batches = 4, trial_samples = 16;
constexpr int first_trial_seed = -trial_batches;  // so that no batch has them

using End = ReferenceProgress::End;

class Batches {
 public:
  explicit Batches(const ReferenceRun& run) : run_(run) {}

  std::optional<double> seconds_left() const {
    if (!run_.seconds) return std::nullopt;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun_;
    return *run_.seconds - spent.count();
  }

  struct Batch {
    Image image;
    double squared_bias = 0;  ///< as in its stats
  };
  /// Renders one batch. Without an image `end` has the reason, and the batch can be resumed.
  std::optional<Batch> render(int batch, int samples, End& end) const {
    const fs::path image = file(batch, ".exr"), whole = file(batch, ".whole.exr");
    if (fs::exists(whole)) return finished(batch);
    const fs::path checkpoint = image.string() + ".checkpoint";
    std::vector<std::string> argv{run_.program.string(),
                                  "render",
                                  "-o",
                                  image.string(),
                                  "--integrator",
                                  run_.integrator,
                                  "--size",
                                  run_.size,
                                  "--spp",
                                  std::to_string(samples),
                                  "--seed",
                                  std::to_string(batch_seed(batch)),
                                  "--threads",
                                  std::to_string(run_.threads),
                                  "--checkpoint",
                                  std::to_string(checkpoint_seconds),
                                  "--quiet"};
    argv.insert(argv.end(), run_.scene.begin(), run_.scene.end());
    if (fs::exists(checkpoint)) argv.emplace_back("--resume");
    ProcessOptions options;
    options.interrupt = run_.interrupt;
    options.wall_limit_seconds = seconds_left();
    const ProcessOutcome outcome = usual_executor().run(argv, options);
    if (outcome.end == ProcessOutcome::End::interrupted || outcome.end == ProcessOutcome::End::timed_out) {
      end = outcome.end == ProcessOutcome::End::timed_out ? End::out_of_time : End::interrupted;
      return std::nullopt;
    }
    if (!outcome.ok())
      throw InputError(run_.scene.front(), "batch " + std::to_string(batch) + " by " + run_.integrator + " " +
                                               outcome.sentence() + ": " + last_line(outcome.standard_error));
    fs::rename(image, whole);  // an interrupted render leaves an image too
    return finished(batch);
  }

  void remove(int batch) const {
    for (const char* extension : {".whole.exr", ".stats.json", ".exr", ".exr.checkpoint"}) {
      std::error_code ignored;
      fs::remove(file(batch, extension), ignored);
    }
  }

  std::string where(int batch) const { return "batch " + std::to_string(batch) + " of " + run_.scene.front(); }

 private:
  Batch finished(int batch) const {
    const fs::path stats = file(batch, ".stats.json");
    const auto json = nlohmann::json::parse(read_file(stats), nullptr, false);
    if (!json.is_object() || !json.contains("counts"))
      throw InputError(stats.string(), "is damaged: delete its folder to begin this reference anew");
    const double bias = json["counts"].value("relative_bias", 0.0);
    return {read_rendering(file(batch, ".whole.exr").string(), "", ImageWindow::stored).mean, bias * bias};
  }

  fs::path file(int batch, const char* extension) const {
    return run_.folder / ("batch" + std::to_string(batch) + extension);
  }

  const ReferenceRun& run_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// The samples per batch with which `least_batches` of them reach the standard error, whose square is proportional to
/// 1/samples. If the estimator has a bias, its square, proportional to samples^(-1/3), must also fall to half of the
/// squared error. Empty where a batch has no image.
std::optional<int> samples_for(const ReferenceRun& run, const Batches& batches, End& end) {
  BatchMeans trial(run.width, run.height, trial_samples);
  for (int i = first_trial_seed; i < 0; ++i) {
    const std::optional<Batches::Batch> batch = batches.render(i, trial_samples, end);
    if (!batch) return std::nullopt;
    trial.add(batch->image, batches.where(i), batch->squared_bias);
  }
  const double ratio = relative_standard_error(trial.rendering()) / run.standard_error;
  const double bias_ratio = std::numbers::sqrt2 * trial.relative_bias() / run.standard_error;
  const double samples = std::max(trial_batches * trial_samples * ratio * ratio / least_batches,
                                  trial_samples * bias_ratio * bias_ratio * bias_ratio);
  constexpr double least = 16, most = 1 << 20;
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::clamp(samples, least, most))));
}

std::optional<double> error_of(const BatchMeans& means) {
  if (means.batches() < 2) return std::nullopt;
  return relative_standard_error(means.rendering());
}

}  // namespace

std::uint64_t batch_seed(int batch) {
  return splitmix64(0x5265666572656e63u, static_cast<std::uint64_t>(std::int64_t{batch}));
}

ReferenceProgress run_reference(const ReferenceRun& run) {
  const Batches batches(run);
  const fs::path state = run.folder / "batches";
  remove_abandoned_temporaries(state);
  End end = End::reached;
  if (!fs::exists(state)) {
    const std::optional<int> samples = samples_for(run, batches, end);
    if (!samples) return {BatchMeans(run.width, run.height, trial_samples), std::nullopt, end};
    BatchMeans(run.width, run.height, *samples).save(state);
    for (int i = first_trial_seed; i < 0; ++i) batches.remove(i);
  }
  BatchMeans means = BatchMeans::load(state);
  if (means.batches() > 0) batches.remove(means.batches() - 1);  // counted, but the run was killed before removing it
  while (true) {
    const std::optional<double> error = error_of(means);
    if (run.progress) run.progress(means, error);
    const int batch = means.batches();
    if (batch >= least_batches && *error <= run.standard_error) return {means, error, End::reached};
    if (const auto left = batches.seconds_left(); left && *left <= 0) return {means, error, End::out_of_time};
    const std::optional<Batches::Batch> next = batches.render(batch, means.samples_per_batch(), end);
    if (!next) return {means, error, end};
    means.add(next->image, batches.where(batch), next->squared_bias);
    means.save(state);
    batches.remove(batch);
  }
}

}  // namespace photonproof::inline harness_references
