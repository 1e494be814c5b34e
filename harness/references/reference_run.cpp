#include "harness/references/reference_run.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "harness/images/image_source.h"
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

ImageSourceOptions source_options(const ReferenceRun& run) {
  ImageSourceOptions options{.use = ImageUse::estimate, .folder = run.folder, .program = run.program};
  options.limits = {.seconds = std::numeric_limits<double>::infinity(), .memory_mb = 0, .threads = run.threads};
  options.reused = {Status::ok};
  options.resumes = true;
  options.interrupt = run.interrupt;
  using std::chrono::steady_clock;
  if (run.seconds)
    options.until = steady_clock::now() +
                    std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(*run.seconds));
  return options;
}

class Batches {
 public:
  explicit Batches(const ReferenceRun& run)
      : run_(run), row_(own_row(run.integrator)), source_(source_options(run)), engine_{&row_} {
    engine_.further = {"--checkpoint", std::to_string(checkpoint_seconds), "--resume"};
    engine_.further.insert(engine_.further.end(), run.arguments.begin(), run.arguments.end());
  }

  struct Batch {
    Image image;
    double squared_bias = 0;  ///< as in its stats
  };
  /// Draws one batch. Without an image `end` has the reason, and the batch can be resumed.
  std::optional<Batch> draw(int batch, int samples, End& end) {
    const std::optional<KeptImage> drawn = source_.draw(engine_, scene_, budget(samples), batch_seed(batch));
    if (!drawn) {
      end = run_.interrupt != nullptr && *run_.interrupt ? End::interrupted : End::out_of_time;
      return std::nullopt;
    }
    const Result& result = drawn->kept.result;
    if (result.status != Status::ok) {
      remove(batch, samples);
      throw InputError(run_.scene.path.string(),
                       "batch " + std::to_string(batch) + " by " + run_.integrator + " " + result.detail);
    }
    const auto bias = result.counts.find("relative_bias");
    return Batch{source_.image_of(result).mean, bias == result.counts.end() ? 0 : bias->second * bias->second};
  }

  void remove(int batch, int samples) const {
    source_.remove(source_.key(engine_, scene_, budget(samples), batch_seed(batch)));
  }

  BatchMeans no_means(int samples) const {
    const FilmPart part = run_.crop.value_or(whole_film(run_.scene.width, run_.scene.height));
    return {part.width, part.height, samples};
  }
  std::string where(int batch) const { return "batch " + std::to_string(batch) + " of " + run_.scene.path.string(); }
  bool are_late() const { return source_.is_late(); }

 private:
  static Budget budget(int samples) { return {"spp", static_cast<double>(samples)}; }

  const ReferenceRun& run_;
  Engine row_;
  ImageSource source_;
  ImageEngine engine_;
  ImageScene scene_{&run_.scene, run_.content, run_.crop};
};

/// The samples per batch with which `least_batches` of them reach the standard error, whose square is proportional to
/// 1/samples. If the estimator has a bias, its square, proportional to samples^(-1/3), must also fall to half of the
/// squared error. Empty where a batch has no image.
std::optional<int> samples_for(const ReferenceRun& run, Batches& batches, End& end) {
  BatchMeans trial = batches.no_means(trial_samples);
  for (int i = first_trial_seed; i < 0; ++i) {
    const std::optional<Batches::Batch> batch = batches.draw(i, trial_samples, end);
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
  Batches batches(run);
  const fs::path state = run.folder / "batches";
  remove_abandoned_temporaries(state);
  End end = End::reached;
  if (!fs::exists(state)) {
    const std::optional<int> samples = samples_for(run, batches, end);
    if (!samples) return {batches.no_means(trial_samples), std::nullopt, end};
    batches.no_means(*samples).save(state);
    for (int i = first_trial_seed; i < 0; ++i) batches.remove(i, trial_samples);
  }
  BatchMeans means = BatchMeans::load(state);
  // The last one is counted, but the run may have been killed before removing it.
  if (means.batches() > 0) batches.remove(means.batches() - 1, means.samples_per_batch());
  while (true) {
    const std::optional<double> error = error_of(means);
    if (run.progress) run.progress(means, error);
    const int batch = means.batches();
    if (batch >= least_batches && *error <= run.standard_error) return {means, error, End::reached};
    if (batches.are_late()) return {means, error, End::out_of_time};
    const std::optional<Batches::Batch> next = batches.draw(batch, means.samples_per_batch(), end);
    if (!next) return {means, error, end};
    means.add(next->image, batches.where(batch), next->squared_bias);
    means.save(state);
    batches.remove(batch, means.samples_per_batch());
  }
}

}  // namespace photonproof::inline harness_references
