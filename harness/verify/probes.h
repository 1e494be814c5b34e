// Calibration probes: micro-scenes with a closed form, one for each kind of light, material, camera and medium. Each
// engine's picture is fitted as image = gain * closed form + offset. So a wrong unit reads "spot light: POV-Ray 1.02x
// closed form" before any whole scene is compared.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "harness/verify/engine_renderer.h"
#include "reports/verify/verify_record.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verify {

/// A file that a probe's scene refers to: a text, or an image that is written as EXR.
struct ProbeFile {
  std::string name;
  std::variant<std::string, Image> content;
};

struct Probe {
  std::string kind;   ///< "light", "material", "camera", "medium"
  std::string what;   ///< "spot light"
  std::string scene;  ///< XML
  /// Radiance in the direction through the image at (x, y), both in [-1, 1], x to the right and y up.
  RgbD (*radiance)(double x, double y) = nullptr;
  std::vector<ProbeFile> files{};  ///< beside the scene
};

const std::vector<Probe>& probe_rows();

/// Writes the scene to this file with the probe's files beside it, and reads it. Throws InputError where it cannot be
/// written.
SceneDescription write_probe(const Probe& probe, const std::filesystem::path& file);

/// Names of the probes for the scene's contents.
std::vector<std::string> kinds_in(const SceneDescription& scene);

struct ProbeFit {
  double gain = 1, gain_error = 0;
  double offset = 0, offset_error = 0;  ///< relative to the closed form's mean
  bool has_offset = false;              ///< the closed form varies enough to separate offset and gain
};

/// Least squares over all pixels and channels, with the closed form averaged over 4 x 4 points a pixel. Errors are the
/// larger of those from the picture's variance and from its residuals.
ProbeFit fit_probe(const Probe& probe, const EnginePicture& picture);

/// Probes the engines by the named kinds, except those in `known`. The cache keeps results by the engine's version, if
/// it has one. Throws VerifyInterrupted.
std::vector<VerifyProbe> probe_engines(const EngineRenderer& renderer, const std::vector<VerifyEngine>& engines,
                                       const std::vector<std::string>& kinds, const std::vector<VerifyProbe>& known);

}  // namespace photonproof::inline harness_verify
