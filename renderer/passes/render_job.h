// The request for a render, and its statistics.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/checkpoint.h"
#include "renderer/core/skips.h"
#include "renderer/kernels/isa.h"
#include "renderer/lanes/sampler.h"
#include "renderer/passes/aov.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_passes {

/// Limits that end a render. Without any, the scene file's sample count does.
struct RenderBudget {
  std::optional<std::int64_t> spp{};      ///< Camera samples per pixel.
  std::optional<std::int64_t> photons{};  ///< Emitted over the whole render, for each map the scene needs.
  std::optional<double> seconds{};        ///< Wall time of the render, photon passes included.
  std::optional<double> target_error{};   ///< Target for Film::relative_standard_error.
};

struct RenderJob {
  RenderBudget budget;
  std::uint64_t seed = 0;
  int threads = 0;       ///< Zero: every core.
  int grid = 0;          ///< If k > 0, samples are on a pixel's k x k grid centres, as POV-Ray's are; 0: random.
  int sample_count = 4;  ///< The scene file's.
  std::string integrator_place = "the scene";  ///< Place of the request for the integrator, for messages.
  SamplerKind sampler = SamplerKind::sobol;
  Aov view = Aov::whole;
  SkipSwitches skips;  ///< the ones that the scene was compiled with
  std::string isa;     ///< instruction set of the kernels; empty: the best available
  const std::atomic<bool>* interrupt = nullptr;
  std::optional<CheckpointPolicy> checkpoint;                               ///< used by render_loop.h
  std::function<void(double fraction, const std::string& phase)> progress;  ///< from one thread at a time; may be empty
  /// Gets the image so far, every `preview_seconds` or less often, while no sample is taken. Empty: nobody looks.
  std::function<void(Rendering image)> preview;
  double preview_seconds = 1;

  /// Throws InputError where `isa` is not a valid name.
  const Kernels& kernels() const { return kernels_for(isa); }
  bool interrupted() const { return interrupt != nullptr && interrupt->load(std::memory_order_relaxed); }
};

struct RenderStats {
  std::map<std::string, double> phases;  ///< Seconds of wall time by phase.
  std::map<std::string, double> counts;  ///< Rays by kind, photons emitted and stored, passes, samples a pixel, radii.
  std::vector<std::string> skipped;      ///< Sentences "what: why".
  std::vector<std::string> choices;      ///< Choices that the render made by itself, with the reason: sentences.
  std::vector<std::string> losses;       ///< Sentences on light that the image may lack, or its variance not show.
  bool interrupted = false;
  std::string checkpoint_problem;  ///< why the last checkpoint that was due could not be written; empty: it was
};

}  // namespace photonproof::inline renderer_passes
