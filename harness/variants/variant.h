// Hidden scenes with a known outcome, made from public ones. A program may know a scene by its number, ship an image or
// skip what public scenes do not need. It cannot prepare for these variants, since a seed draws them.
//
// | kind | scene | its image |
// |---|---|---|
// | mirror | mirrored left to right as the camera sees it | the base's, mirrored |
// | rigid-move | everything, camera and lights too, turned and moved | the base's |
// | light-scale | every light brighter by the same factor, more than 1 | the base's times this, before it is clamped |
// | colour-permutation | channels of every reflectance and light exchanged | the base's with its channels exchanged |
// | superposition | a light cut in two, which shine together | the base's |
// | object-order | objects in another order | the base's |
// | resolution | fewer pixels | means of the base's pixels |
// | crop | a narrower view | the middle of a base that is rendered with more pixels |
// | more-spheres | spheres put where there is room | a new reference |
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "harness/variants/own_engine.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_variants {

struct VariantOptions {
  /// For programs that need boxes and walls along the axes, a camera at its image's middle, and level water. Then
  /// rigid-move turns by quarters about the vertical, or not at all with water, and crop keeps to the middle.
  bool axis_aligned = false;
};

struct Variant {
  std::string kind;
  std::uint64_t seed = 0;
  SceneDescription scene;               ///< its film has the variant's size
  int width = 0, height = 0;            ///< of the variant's image
  int base_width = 0, base_height = 0;  ///< of the base's image that the prediction starts from
  std::string says;                     ///< what was done, and what follows: "every light 1.4 times as bright: ..."
  /// Predicts the variant's linear image from the base's; empty: a new reference must be rendered. Where the base is
  /// clamped at white, the prediction is right after clamping too.
  std::function<Image(const Image&)> predicted;
  std::function<Image(const Image&)> predicted_variance;  ///< variance of the pixels, from the base's
  bool needs_reference() const { return !predicted; }
  /// Whether the prediction starts from a base of the requested size.
  bool starts_from_usual_base() const { return !needs_reference() && usual_base; }
  bool usual_base = true;
};

/// Names of the kinds, in the order of the table above.
const std::vector<std::string>& variant_kinds();

/// The variant of this kind for a scene with images of this size; the same arguments give the same variant. Throws
/// InputError with the reason where the kind is unknown or the scene does not allow it.
Variant make_variant(const std::string& kind, std::uint64_t seed, const SceneDescription& base, int width, int height,
                     const VariantOptions& options = {});

struct PredictionCheck {
  int longer_side = 48;  ///< pixels of the check's images
  int spp = 256;
  std::string integrator = "path";
  double alpha = 0.001;  ///< of one comparison; a prediction fails when two with different seeds both fail
};

/// Renders base and variant with our own engine and tests the prediction by `agreement`
/// (harness/statistics/agreement.h). Empty if it holds, or if there is none; else the reason why the variant must not
/// be used. Throws InputError when a render fails.
std::string check_prediction(const Variant& variant, const SceneDescription& base, const OwnEngine& engine,
                             const VariantOptions& options = {}, const PredictionCheck& check = {});

}  // namespace photonproof::inline harness_variants
