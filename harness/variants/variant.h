// Hidden scenes with a known outcome, made from public ones. What a program that knows a scene by its number, ships an
// image or skips what the public scenes do not need shows here cannot be prepared for: the variant is drawn by a seed.
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
  /// For programs that know boxes and walls along the axes, a camera that looks at its image's middle, and level water:
  /// rigid-move turns by quarters (about the vertical alone, and not at all where there is water), crop keeps to the
  /// middle.
  bool axis_aligned = false;
};

struct Variant {
  std::string kind;
  std::uint64_t seed = 0;
  SceneDescription scene;               ///< its film has the variant's size
  int width = 0, height = 0;            ///< of the variant's image
  int base_width = 0, base_height = 0;  ///< of the base's image that the prediction starts from
  std::string says;                     ///< what was done, and what follows: "every light 1.4 times as bright: ..."
  /// From the linear image of the base; empty: a new reference must be rendered. Where the base is clamped at white,
  /// the prediction is right once it is clamped, too.
  std::function<Image(const Image&)> predicted;
  std::function<Image(const Image&)> predicted_variance;  ///< of the pixels, from the base's
  bool needs_reference() const { return !predicted; }
  /// Whether the base that the prediction starts from has the size that was asked for.
  bool starts_from_usual_base() const { return !needs_reference() && usual_base; }
  bool usual_base = true;
};

/// In the order of the table above.
const std::vector<std::string>& variant_kinds();

/// The variant of this kind of a scene whose images have this size. The same arguments, the same variant. Throws
/// InputError where the kind is unknown or the scene does not allow it, and says why.
Variant make_variant(const std::string& kind, std::uint64_t seed, const SceneDescription& base, int width, int height,
                     const VariantOptions& options = {});

struct PredictionCheck {
  int longer_side = 48;  ///< pixels of what is rendered for it
  int spp = 256;
  std::string integrator = "path";
  double alpha = 0.001;  ///< of one comparison; a prediction falls when two with other seeds both fail
};

/// Our own engine renders base and variant, and `agreement` (harness/statistics/agreement.h) tests the prediction.
/// Empty where it holds, or nothing is predicted; else why the variant must not be used. Throws InputError when a
/// render fails.
std::string check_prediction(const Variant& variant, const SceneDescription& base, const OwnEngine& engine,
                             const VariantOptions& options = {}, const PredictionCheck& check = {});

}  // namespace photonproof::inline harness_variants
