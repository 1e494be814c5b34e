// Calibration probes: micro-scenes with a closed form, one a kind of light, material, camera and medium. Each engine's
// picture is fitted to it, image = gain * closed form + offset, so that a wrong unit reads "spot light: POV-Ray 1.02x
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

/// What a probe's scene names: a text, or an image that is written as EXR.
struct ProbeFile {
  std::string name;
  std::variant<std::string, Image> content;
};

struct Probe {
  std::string kind;   ///< "light", "material", "camera", "medium"
  std::string what;   ///< "spot light"
  std::string scene;  ///< XML
  /// Of the direction through the image at (x, y), both in [-1, 1], x to the right and y up.
  RgbD (*radiance)(double x, double y) = nullptr;
  std::vector<ProbeFile> files{};  ///< beside the scene
};

const std::vector<Probe>& probe_rows();

/// The scene as this file, and the probe's files beside it; reads it. Throws InputError where it cannot be written.
SceneDescription write_probe(const Probe& probe, const std::filesystem::path& file);

/// The probes' names of what the scene holds.
std::vector<std::string> kinds_in(const SceneDescription& scene);

struct ProbeFit {
  double gain = 1, gain_error = 0;
  double offset = 0, offset_error = 0;  ///< relative to the closed form's mean
  bool has_offset = false;              ///< the closed form varies enough to tell it from the gain
};

/// Least squares over all pixels and channels. The closed form is averaged over 4 x 4 points a pixel. Errors are the
/// larger of what the picture's variance and its residuals say.
ProbeFit fit_probe(const Probe& probe, const EnginePicture& picture);

/// Of the engines and the named kinds, without those that `known` has. Results are kept in the cache by the engine's
/// version, where it tells one. Throws VerifyInterrupted.
std::vector<VerifyProbe> probe_engines(const EngineRenderer& renderer, const std::vector<VerifyEngine>& engines,
                                       const std::vector<std::string>& kinds, const std::vector<VerifyProbe>& known);

}  // namespace photonproof::inline harness_verify
