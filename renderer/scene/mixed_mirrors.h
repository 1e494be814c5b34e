// Blends with a mirror as in Mitsuba 3.9.1 (BlendDescription::mixes_mirrors). It weights the mirror's sample against
// the density d of the other BSDF, as if the mirror had a density, too: its own probability q. The mirror has the share
// w and the value v. The other BSDF has the value f, with the cosine. The sample's weight is then
//   (w q v + (1 - w) f) / (w q + (1 - w) d)   in place of   v.
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/scene/surface_detail.h"

namespace photonproof::inline renderer_scene {

/// Replaces the reflectance in `mirror`, the record of a leaf of this kind, by what gives that weight. `share` is the
/// mirror's, `other` the record of the other leaf. `wo` points away from the surface, in the frame of both. Other kinds
/// than conductors and dielectrics are left as they are.
void mix_mirror(std::uint32_t kind, float* mirror, float share, std::uint32_t other_kind, const float* other,
                const Vec3f& wo);

}  // namespace photonproof::inline renderer_scene
