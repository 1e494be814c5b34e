// Writes a scene in a course's own format, by a template of the course (mustache; nothing is escaped). Its names:
//
// `width` `height` of the image. `shift_x` `shift_y`: pixels by which it lies right of and below the view's middle (0
// except in crops). `camera` {x y z, view direction dx dy dz, up ux uy uz (both of length 1), fov (vertical, degrees),
// near}. `objects`, in the scene's order, each {index, name, last}. One of kind_sphere kind_rectangle kind_box
// kind_water is true, and one of material_diffuse material_mirror material_glass material_light. Materials have r g b:
// albedo, a mirror's reflectance, or glass's transmittance (1 for water). They have ior (glass, inside to outside) and
// er eg eb (a light's radiance). A sphere has x y z radius. A rectangle has its centre x y z, half edges ax ay az bx by
// bz, and the normal a x b. A box has its centre x y z and half edges a b c. Water has the centre x y z of its level
// surface and half edges a b. Its c is the displacement where the noise is 1, and it has columns and rows of cells
// along a and b. Its noise has frequency_x frequency_y (cells a half edge) and noise_seed, as in heightfield.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Numbers are the shortest decimals. Names are letters, digits, '-' and '_'; other characters become '_'. Throws
/// InputError naming the object that these terms cannot express (a texture, another shape or material, a point light, a
/// shifted camera). Also throws where the template is malformed or uses an unknown name.
std::string scene_file_text(const SceneDescription& scene, int width, int height, const std::string& mustache_template,
                            const std::string& template_file);

}  // namespace photonproof::inline harness_variants
