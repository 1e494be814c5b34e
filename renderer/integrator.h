// What every integrator takes and gives back, and the table of them. An integrator is one file and one row.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/checkpoint.h"
#include "renderer/film.h"
#include "renderer/isa.h"
#include "renderer/scene.h"
#include "renderer/skips.h"

namespace photonproof {

/// What ends a render. Without any, the scene file's sample count does.
struct RenderBudget {
  std::optional<std::int64_t> spp;      ///< camera samples a pixel
  std::optional<std::int64_t> photons;  ///< emitted over the whole render, for each map the scene needs
  std::optional<double> seconds;        ///< wall time of the render, photon passes included
  std::optional<double> target_error;   ///< Film::relative_standard_error that is small enough
};

struct RenderJob {
  RenderBudget budget;
  std::uint64_t seed = 0;
  int threads = 0;       ///< 0: every core
  int grid = 0;          ///< k > 0: samples on the centres of a k x k grid in the pixel, as POV-Ray's are; 0: random
  int sample_count = 4;  ///< of the scene file
  std::string integrator_place = "the scene";  ///< where it asks for the integrator, for messages
  SamplerKind sampler = SamplerKind::sobol;
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
  std::vector<std::string> losses;       ///< what the picture may lack, or its variance not know: sentences
  bool interrupted = false;
  std::string checkpoint_problem;  ///< why the last checkpoint that was due could not be written; empty: it was
};

/// Renders into the film until the budget or an interrupt ends it. Deterministic for a given number of samples and
/// photons: neither threads nor time enter the estimates. Passes go through render_loop.h, which gives an integrator
/// budget, progress, Ctrl-C, checkpoints and --resume. The film may be a window of the image: pixels outside of it are
/// not asked for.
struct Integrator {
  const char* name;
  const char* summary;
  void (*render)(const Scene&, const IntegratorDescription&, const RenderJob&, Film&, RenderStats&);
  /// What of a job it heeds; the rest is refused rather than ignored (check_supported.h).
  struct Heeds {
    bool photons = false;  ///< the budget's
    bool grid = true;
    bool isa = true;
    bool target_error = false;  ///< its film tells its error after every pass
  } heeds = {};
  /// What of a scene it can do.
  enum class Media { none, absorbing, all } media = Media::none;
  bool dielectric_priorities = false;

  /// Up to how many primitives it traces rays without Embree.
  std::size_t small_limit() const { return heeds.isa ? small_scene_limit : small_scene_limit_of_single_rays; }
};

const std::vector<Integrator>& integrators();
/// Null when there is none of that name.
const Integrator* find_integrator(const std::string& name);
/// The name of the integrator a scene file asks for.
std::string integrator_name(const IntegratorDescription& description);
/// The same request for another integrator: path depth, roulette depth and hidden emitters are kept, what the scene
/// file does not say takes its default. `name` must be one that a scene file may use.
IntegratorDescription with_integrator(const IntegratorDescription& description, const std::string& name);

}  // namespace photonproof
