// A scene in a course's own format, which only a template of the course knows (mustache; nothing is escaped). What the
// template may name:
//
// `width` `height` of the image, `shift_x` `shift_y`, pixels by which it lies right of and below the view's middle
// (0 but of crops); `camera` {x y z, view direction dx dy dz, up ux uy uz (both of length 1), fov
// (vertical, degrees), near}; `objects`, in the scene's order, each {index, name, last; true where it is one of
// kind_sphere kind_rectangle kind_box kind_water, and of material_diffuse material_mirror material_glass
// material_light; r g b (albedo; what a mirror reflects; what glass transmits, 1 of water); ior (glass, of the inside
// to the outside); er eg eb (radiance of a light); sphere: x y z radius; rectangle: centre x y z, half edges ax ay az
// bx by bz, whose cross product a x b is its normal; box: centre x y z and half edges a b c; water: centre x y z of the
// level surface, half edges a b, the displacement c where the noise is 1, columns and rows of cells along a and b, and
// of the noise frequency_x frequency_y (cells a half edge) and noise_seed, as heightfield has them}.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Numbers are the shortest decimals; names are letters, digits, '-' and '_', other characters become '_'. Throws
/// InputError, which names the object, where these words cannot say the scene (a texture, another shape or material, a
/// point light, a shifted camera), and where the template is malformed or names what is not there.
std::string scene_file_text(const SceneDescription& scene, int width, int height, const std::string& mustache_template,
                            const std::string& template_file);

}  // namespace photonproof::inline harness_variants
