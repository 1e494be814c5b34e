// What is asked of a render, and what it says of itself afterwards.
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

namespace photonproof::inline renderer_passes {

/// What ends a render. Without any, the scene file's sample count does.
struct RenderBudget {
  std::optional<std::int64_t> spp{};      ///< camera samples a pixel
  std::optional<std::int64_t> photons{};  ///< emitted over the whole render, for each map the scene needs
  std::optional<double> seconds{};        ///< wall time of the render, photon passes included
  std::optional<double> target_error{};   ///< Film::relative_standard_error that is small enough
};

struct RenderJob {
  RenderBudget budget;
  std::uint64_t seed = 0;
  int threads = 0;       ///< 0: every core
  int grid = 0;          ///< k > 0: samples on the centres of a k x k grid in the pixel, as POV-Ray's are; 0: random
  int sample_count = 4;  ///< of the scene file
  std::string integrator_place = "the scene";  ///< where it asks for the integrator, for messages
  SamplerKind sampler = SamplerKind::sobol;
  Aov view = Aov::whole;
  SkipSwitches skips;  ///< the ones the scene was compiled with
  std::string isa;     ///< instruction set of the kernels; empty: the best there is
  const std::atomic<bool>* interrupt = nullptr;
  std::optional<CheckpointPolicy> checkpoint;                               ///< render_loop.h sees to it
  std::function<void(double fraction, const std::string& phase)> progress;  ///< from one thread at a time; may be empty

  /// Throws InputError where `isa` names none.
  const Kernels& kernels() const { return kernels_for(isa); }
  bool interrupted() const { return interrupt != nullptr && interrupt->load(std::memory_order_relaxed); }
};

struct RenderStats {
  std::map<std::string, double> phases;  ///< seconds of wall time by phase
  std::map<std::string, double> counts;  ///< rays by kind, photons emitted and stored, passes, samples a pixel, radii
  std::vector<std::string> skipped;      ///< "what: why"
  std::vector<std::string> choices;      ///< what the render decided by itself, and why: sentences
  std::vector<std::string> losses;       ///< what the picture may lack, or its variance not know: sentences
  bool interrupted = false;
  std::string checkpoint_problem;  ///< why the last checkpoint that was due could not be written; empty: it was
};

}  // namespace photonproof::inline renderer_passes
