// What is wrong with a picture, in sentences that whoever wrote the program understands: what, where, and a possible
// cause. The picture is compared with the reference; hypotheses then compete for the difference. Each is a change of
// the expected picture: turned over, another gamma, a feature's light left out, or the picture of a scene with the
// mistake built in (knowledge.h). A hypothesis becomes a sentence only if it explains nearly all of the difference,
// fits it about as well as noise allows, and no other comes near it. Otherwise the finding is "differs".
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

/// What one kind of light adds to the picture: "direct", "caustic", "indirect", "indirect after the first bounce" ...
struct FeatureProbe {
  std::string feature;
  Image light;                ///< its share of the model's radiance
  std::vector<float> weight;  ///< a pixel, 0 to 1: how much it is that light which is seen there
};

/// The picture of the scene with one mistake built in.
struct WhatIf {
  std::string kind;      ///< of the finding: "hard-shadows"
  std::string sentence;  ///< "shadow edges hard"
  std::string cause;
  std::string landmark;  ///< where it shows, or empty: where it differs most
  Lazy<Image> image;
  /// A pixel: not 0 where it surely changes the picture. Empty: unknown.
  std::vector<std::uint8_t> changes = {};
  bool only_there = false;  ///< and nowhere else
  bool rough = false;       ///< the picture changes as this one does, but more
  bool rare = false;        ///< asked where nothing usual explains the picture
  /// Of mistakes that change a fine pattern: what they change, the picture with less the one without, with noise so low
  /// that it can be told within the noise of what is submitted.
  std::optional<Lazy<Image>> fine = std::nullopt;
};

/// What the scene's light is made of.
struct SceneLight {
  Image model;  ///< our engine's picture, which probes and what-ifs differ from; empty: reference
  std::vector<FeatureProbe> probes;
  std::vector<WhatIf> formulas;  ///< of direct light
};

struct Landmark {
  std::string name;     ///< "glass sphere", "left wall"
  double x = 0, y = 0;  ///< pixels: the middle of what is seen of it
  double radius = 0;    ///< pixels: of a disc as large as what is seen
};

struct SceneKnowledge {
  Image reference;                ///< linear; may be brighter than white
  std::optional<Image> variance;  ///< of the reference
  std::optional<Image> baseline;  ///< one render by the program that the author began with
  std::optional<float> white;     ///< where the submitted picture is clamped
  Lazy<SceneLight> light;
  std::vector<WhatIf> what_ifs;
  std::vector<Landmark> landmarks;
  /// A pixel: 1 + the index of the landmark that is seen there, 0 where none is. Empty: unknown.
  std::vector<std::uint16_t> seen;
  std::vector<std::pair<std::string, Image>> other_images;  ///< "scene 1": of the other scenes, in their own sizes
  /// Two right programs may differ by this much of a block's radiance.
  double tolerance = 0.08;

  /// What probes and what-ifs differ from: our engine's picture, or the reference where there is none.
  const Image& model() const {
    const Image& ours = light.get().model;
    return ours.rgb.empty() ? reference : ours;
  }
};

struct Finding {
  std::string kind;      ///< "upside-down", "black-lines", "caustic-missing" ...; "differs": not explained
  std::string sentence;  ///< "caustic missing below the glass sphere"
  std::string cause;     ///< "no photons are shot at it, or none are looked up"; may be empty
  PixelRegion where;
  double explained = 0;  ///< share of the squared error that it accounts for
};

/// What is broken first, then at most one explanation, or "differs" with its place; empty where nothing stands out of
/// the noise and the tolerance. The submitted picture is linear, top row first. Never throws for what a picture holds:
/// another size and values that are not finite are findings, too. Renders what it needs of the knowledge, and throws
/// InputError where that fails.
std::vector<Finding> diagnose(const Image& submitted, const SceneKnowledge& knowledge);

/// "differs" for a picture that is within its bounds, where a mistake in a fine pattern, as of waves, or in the look of
/// one body is there in full and far above noise (faint.h). Broad changes are not looked for: errors of an irradiance
/// cache look like them. Empty for pictures of another size, or with values that are not finite. At most one.
std::vector<Finding> find_hidden_mistake(const Image& submitted, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
