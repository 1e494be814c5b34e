// What is expected of a scene: the expect.toml beside its scene.xml.
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
  std::optional<RgbD> mean;  ///< of the whole image at the scene's default parameters, radiance
};

/// A bound on a metric that is wider than the suite's, for one engine, and why it has to be.
struct Tolerance {
  std::string engine;
  std::string metric;  ///< a name of the metrics table
  double value = 0;    ///< largest allowed magnitude
  std::string reason;
  std::optional<double> block{};  ///< of blocks of 8 x 8 pixels, relative to their mean, where verify compares them
};

/// The mean's difference over images of several seeds, where one image's noise, or POV-Ray's cache, hides it.
struct PairsResidual {
  int count = 0;             ///< of pairs of an image by the engine, POV-Ray by paths, and one by us
  double mean_percent = 0;   ///< signed difference of the means
  double noise_percent = 0;  ///< its standard error, as the pairs' spread says
};

/// How far the scene's picture by Cycles is from ours, measured once by the same script, and what it costs.
struct CyclesResidual {
  int size = 0;              ///< pixels across and down
  int spp = 0;               ///< samples a pixel
  double mean_percent = 0;   ///< signed difference of the means
  double noise_percent = 0;  ///< standard error of Cycles' mean, as its batches say
  double relmse = 0;
  double ssim = 0;
  double seconds = 0;                    ///< of processor time
  std::optional<PairsResidual> pairs{};  ///< where the mean is off by more than is aimed for
  std::optional<std::string> cause;      ///< why it is more than is aimed for, where it is

  /// What is aimed for: a mean within 0.3 % of ours, or within three standard errors where those are wider.
  bool is_small() const {
    const auto is_near = [](double mean, double noise) {
      const double most = 3 * noise > 0.3 ? 3 * noise : 0.3;
      return mean >= -most && mean <= most;
    };
    return is_near(mean_percent, noise_percent) && (!pairs || is_near(pairs->mean_percent, pairs->noise_percent));
  }
};

/// How far the scene's picture by POV-Ray is from the truth by our reference integrators, measured once
/// (reference/measure_library.py), and what it costs.
struct PovrayResidual {
  int size = 0;             ///< pixels across; down as the library's reference has, or as many
  int quality = 0;          ///< the preset
  double mean_percent = 0;  ///< signed difference of the means
  double relmse = 0;
  double ssim = 0;
  double seconds = 0;                    ///< of processor time
  std::optional<PairsResidual> pairs{};  ///< where the mean is off by more than is aimed for
  std::optional<std::string> cause;      ///< why it is more than is aimed for, where it is

  /// What is aimed for: a mean within half a percent and an ssim of at least 0.98.
  bool is_small() const { return mean_percent >= -0.5 && mean_percent <= 0.5 && ssim >= 0.98; }
};

struct Expect {
  std::string purpose;                             ///< one sentence
  double exposure = 0;                             ///< stops for display and for display-encoded metrics
  std::optional<ExposureRange> hdr_exposures;      ///< hdr_flip_exposures = [start, stop, count]; without, no hdr_flip
  std::optional<Analytic> analytic;                ///< where a closed form exists
  std::map<std::string, std::string> unsupported;  ///< engine -> why it cannot render the scene
  std::vector<Tolerance> tolerances;
  std::optional<PovrayResidual> povray;  ///< where POV-Ray can render the scene
  std::optional<CyclesResidual> cycles;  ///< where Cycles can
};

/// Throws InputError, with file:line:col where TOML gives a position, when the file is missing, malformed, lacks a
/// key or has one that is not known.
Expect read_expect(const std::string& path);

/// The expect.toml of a scene file: the same folder's.
std::string expect_path_of(const std::string& scene_path);

}  // namespace photonproof::inline scenes_description
