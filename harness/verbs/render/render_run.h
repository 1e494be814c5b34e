// Runs `photonproof render` after its command line is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/verbs/scene_options.h"

namespace photonproof::inline harness_verbs_render {

struct RenderArguments {
  SceneOptions scene;
  std::string output;
  std::string stats_path;
  std::string preset;  ///< of render_presets; empty: none
  std::string integrator;
  std::string indirect;  ///< of indirect_words; empty: the scene's
  std::optional<std::int64_t> spp, photons;
  std::optional<double> seconds, target_error;
  std::optional<double> exposure;  ///< of a PNG, in stops
  std::uint64_t seed = 0;
  int threads = 0;
  int grid = 0;
  std::string sampler = "sobol";
  std::string view = "whole";
  std::string isa;
  std::string progress = "auto";
  std::string preview;  ///< "tev", "tev:PORT" or "tev:HOST:PORT"; empty: none
  std::vector<std::string> no_skip;
  bool denoise = false;
  std::vector<int> crop;  ///< x, y, width, height; empty: the scene's
  double checkpoint_seconds = 60;
  bool resume = false;
  bool plan = false;
  bool json = false;
};

/// Renders, or prints the plan. Returns the exit code: 0 done, 1 done but some values are not finite or the image could
/// not be denoised, 130 interrupted (partial results kept). Throws InputError.
int run_render(const RenderArguments& arguments);

}  // namespace photonproof::inline harness_verbs_render
