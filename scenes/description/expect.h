// Expected results of a scene: the expect.toml beside its scene.xml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/base/vec.h"
#include "scenes/images/exposure_range.h"

namespace photonproof::inline scenes_description {

struct Analytic {
  std::string formula;       ///< in words and symbols, for reports
  std::optional<RgbD> mean;  ///< radiance, mean over the image at the scene's default parameters
};

/// A bound on a metric that is wider than the suite's, for one engine, with its reason.
struct Tolerance {
  std::string engine;
  std::string metric;  ///< a name of the metrics table
  double value = 0;    ///< largest allowed magnitude
  std::string reason;
  std::optional<double> block{};  ///< for blocks of 8 x 8 pixels, relative to their mean, where verify compares them
};

/// The mean's difference over images of several seeds, where one image's noise or POV-Ray's cache hides it.
struct PairsResidual {
  int count = 0;             ///< pairs of an image by the engine, POV-Ray by paths, and one of ours
  double mean_percent = 0;   ///< signed difference of the means
  double noise_percent = 0;  ///< its standard error, from the pairs' spread
};

/// The difference of the scene's image by Cycles from ours, measured once by the same script, and its cost.
struct CyclesResidual {
  int size = 0;              ///< pixels across and down
  int spp = 0;               ///< samples a pixel
  double mean_percent = 0;   ///< signed difference of the means
  double noise_percent = 0;  ///< standard error of Cycles' mean, from its batches
  double relmse = 0;
  double ssim = 0;
  double seconds = 0;                    ///< of processor time
  std::optional<PairsResidual> pairs{};  ///< where the mean's error exceeds the target
  std::optional<std::string> cause;      ///< why it exceeds the target, where it does

  /// Whether the residual meets the target: a mean within 0.3 % of ours, or within three standard errors if wider.
  bool is_small() const {
    const auto is_near = [](double mean, double noise) {
      const double most = 3 * noise > 0.3 ? 3 * noise : 0.3;
      return mean >= -most && mean <= most;
    };
    return is_near(mean_percent, noise_percent) && (!pairs || is_near(pairs->mean_percent, pairs->noise_percent));
  }
};

/// The error of the scene's image by POV-Ray against our reference integrators, and its cost, measured once
/// (reference/measure_library.py).
struct PovrayResidual {
  int size = 0;             ///< pixels across; down as the library's reference has, else as many
  int quality = 0;          ///< the preset
  double mean_percent = 0;  ///< signed difference of the means
  double relmse = 0;
  double ssim = 0;
  double seconds = 0;                    ///< of processor time
  std::optional<PairsResidual> pairs{};  ///< where the mean's error exceeds the target
  std::optional<std::string> cause;      ///< why it exceeds the target, where it does

  /// Whether the residual meets the target: a mean within half a percent and an ssim of at least 0.98.
  bool is_small() const { return mean_percent >= -0.5 && mean_percent <= 0.5 && ssim >= 0.98; }
};

struct Expect {
  std::string title;                               ///< Name of the scene on pages; empty: its own.
  std::string purpose;                             ///< One sentence.
  double exposure = 0;                             ///< Stops for display and for display-encoded metrics.
  std::optional<ExposureRange> hdr_exposures;      ///< hdr_flip_exposures = [start, stop, count]; empty: no hdr_flip.
  std::optional<Analytic> analytic;                ///< Where a closed form exists.
  std::map<std::string, std::string> unsupported;  ///< Engine -> why it cannot render the scene.
  std::vector<Tolerance> tolerances;
  std::optional<PovrayResidual> povray;  ///< Where POV-Ray can render the scene.
  std::optional<CyclesResidual> cycles;  ///< Where Cycles can.
};

/// Throws InputError, with file:line:col where TOML gives a position, when the file is missing or malformed, or lacks a
/// key or has an unknown one.
Expect read_expect(const std::string& path);

/// The expect.toml of a scene file: the same folder's.
std::string expect_path_of(const std::string& scene_path);

}  // namespace photonproof::inline scenes_description
