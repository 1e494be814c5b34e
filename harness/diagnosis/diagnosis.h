// The defects of a picture in sentences for the author of the program: the defect, its place and a possible cause. The
// picture is compared with the reference; hypotheses then compete for the difference. Each is a change of the expected
// picture: turned over, another gamma, a feature's light left out, or a mistake built into the scene (knowledge.h). A
// hypothesis becomes a sentence only if it explains nearly all of the difference and fits it about as well as noise
// allows. No other may come near it. Otherwise the finding is "differs".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/diagnosis/lazy.h"
#include "harness/pixels/pixel_region.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis {

/// One kind of light of the picture: "direct", "caustic", "indirect", "indirect after the first bounce" ...
struct FeatureProbe {
  std::string feature;
  Image light;                ///< Its share of the model's radiance.
  std::vector<float> weight;  ///< For each pixel, the share of this light, 0 to 1.
};

/// The picture of the scene with one mistake built in.
struct WhatIf {
  std::string kind;      ///< Kind of the finding: "hard-shadows".
  std::string sentence;  ///< "shadow edges hard".
  std::string cause;
  std::string landmark;  ///< Where it shows; empty: where it differs most.
  Lazy<Image> image;
  /// For each pixel, not 0 where the mistake surely changes the picture. Empty: unknown.
  std::vector<std::uint8_t> changes = {};
  bool only_there = false;  ///< The mistake changes no other pixels.
  bool rough = false;       ///< The picture changes in this way, but more.
  bool rare = false;        ///< Tried where no usual mistake explains the picture.
  /// The change of the picture, for mistakes that change a fine pattern: the picture with less the one without. Its
  /// noise is so low that the pattern can be found within the noise of the submitted picture.
  std::optional<Lazy<Image>> fine = std::nullopt;
};

/// The scene's light, split into its parts.
struct SceneLight {
  Image model;  ///< Our engine's picture, the base of probes and what-ifs; empty: reference.
  std::vector<FeatureProbe> probes;
  std::vector<WhatIf> formulas;  ///< Formulas of direct light.
};

struct Landmark {
  std::string name;     ///< "glass sphere", "left wall".
  double x = 0, y = 0;  ///< The middle of its visible part, in pixels.
  double radius = 0;    ///< Radius in pixels of a disc as large as its visible part.
};

struct SceneKnowledge {
  Image reference;                ///< Linear; may be brighter than white.
  std::optional<Image> variance;  ///< Variance of the reference.
  std::optional<float> white;     ///< The value at which the submitted picture is clamped.
  Lazy<SceneLight> light;
  std::vector<WhatIf> what_ifs;
  std::vector<Landmark> landmarks;
  /// For each pixel, 1 + the index of the landmark seen there, 0 where there is none. Empty: unknown.
  std::vector<std::uint16_t> seen;
  std::vector<std::pair<std::string, Image>> other_images;  ///< "scene 1": pictures of the other scenes, in their own
                                                            ///< sizes.
  /// Two right programs may differ by this fraction of a block's radiance.
  double tolerance = 0.08;

  /// The base of probes and what-ifs: our engine's picture, or the reference where there is none.
  const Image& model() const {
    const Image& ours = light.get().model;
    return ours.rgb.empty() ? reference : ours;
  }
};

struct Finding {
  std::string kind;      ///< "upside-down", "black-lines", "caustic-missing" ..., or "differs" if unexplained.
  std::string sentence;  ///< "caustic missing below the glass sphere".
  std::string cause;     ///< "no photons are shot at it, or none are looked up"; may be empty.
  PixelRegion where;
  double explained = 0;  ///< Share of the squared error that it explains.
};

/// Returns breakage first, then at most one explanation, or "differs" with its place; empty where the picture agrees up
/// to noise and tolerance. The submitted picture is linear, top row first. A picture never makes it throw: another size
/// and values that are not finite are findings, too. It renders the knowledge that it needs, and throws InputError
/// where that fails.
std::vector<Finding> diagnose(const Image& submitted, const SceneKnowledge& knowledge);

/// Returns "differs" for a picture within its bounds that has a mistake in full and far above noise. It looks for
/// mistakes in a fine pattern, such as waves, or in the look of one body (faint.h). It ignores broad changes: errors of
/// an irradiance cache look like them. Empty for pictures of another size, or with values that are not finite. At most
/// one.
std::vector<Finding> find_hidden_mistake(const Image& submitted, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
