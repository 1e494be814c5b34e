// A gate suite: which engine must keep which bound on which scene. A TOML file, read strictly:
//   name, title
//   alpha      false-alarm rate of one gate over all its looks (optional; 0.001)
//   seeds      images a gate starts from (optional; 8); every further look doubles their number
//   looks      how often a gate looks at most (optional; 4)
//   [limits]   seconds, memory_mb, threads: of one image, as in a benchmark suite (each optional; threads 1)
//   [[engine]] further engines, as in engines.toml
//   [[scene]]  name, path (relative to this file), width, height, exposure (optional: the scene's expect.toml says it)
//   [[gate]]   scene, engine
//              budget       of one image: "spp=16"
//              metric       what is bounded, see below
//              bound        of the metric; relative for agreement, bias and block_bias (0.01 is 1 %)
//              block_bound  with agreement only (optional; 5 times bound)
//              name         (optional; scene/engine/metric), alpha, seeds, looks (optional; the suite's)
//
// Metrics. The reference is the scene's stored one (`photonproof reference`).
//   agreement   for unbiased engines: no deviation that noise does not explain, and enough images that an error of
//               `bound` of the whole image or `block_bound` of a block of 8 x 8 pixels would have shown
//   bias        the whole image's mean, in each channel, within +-bound of the reference's
//   block_bias  every block's mean within +-bound of the reference's; dark blocks relative to the image's mean
//   any metric of `compare` (relmse, ssim, flip ...): its expectation for one image of this budget, at least `bound`
//               for psnr and ssim, at most for the others; hdr_flip where the scene's expect.toml pins its exposures
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/suite.h"

namespace photonproof {

struct Gate {
  std::string name;
  std::string scene, engine;  ///< names
  Budget budget;              ///< of one image
  std::string metric;
  double bound = 0;
  double block_bound = 0;  ///< agreement only
  double alpha = 0;
  int seeds = 0;  ///< images at the first look
  int looks = 0;
  bool takes_seed = true;  ///< its engine's command has a {seed}
};

/// Its scenes are without SuiteScene::reference.
struct GateSuite : SuiteCommon {
  std::vector<Gate> gates;
};

inline constexpr const char* agreement_metric = "agreement";
inline constexpr const char* bias_metric = "bias";
inline constexpr const char* block_bias_metric = "block_bias";

/// Throws InputError with file:line:col on anything but the above.
GateSuite read_gate_suite(const std::filesystem::path& file);

}  // namespace photonproof
