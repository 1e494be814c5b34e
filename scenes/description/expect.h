// What is expected of a scene: the expect.toml beside its scene.xml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/images/exposure_range.h"
#include "scenes/meshes/vec.h"

namespace photonproof {

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
};

struct Expect {
  std::string purpose;                             ///< one sentence
  double exposure = 0;                             ///< stops for display and for display-encoded metrics
  std::optional<ExposureRange> hdr_exposures;      ///< hdr_flip_exposures = [start, stop, count]; without, no hdr_flip
  std::optional<Analytic> analytic;                ///< where a closed form exists
  std::map<std::string, std::string> unsupported;  ///< engine -> why it cannot render the scene
  std::vector<Tolerance> tolerances;
};

/// Throws InputError, with file:line:col where TOML gives a position, when the file is missing, malformed, lacks a
/// key or has one that is not known.
Expect read_expect(const std::string& path);

/// The expect.toml of a scene file: the same folder's.
std::string expect_path_of(const std::string& scene_path);

}  // namespace photonproof
