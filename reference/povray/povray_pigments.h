// Colours and textures as POV-Ray pigments, and the image files they read.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reference/povray/povray_scene.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_povray {

/// An image that the exported text reads; it is written beside the text.
struct PovFile {
  std::string name;
  std::shared_ptr<const Image> image;
};

/// "pigment{...}" over the plane of u and v, z = 0. Where u and v follow from a place on a round shape, it is over the
/// shape's own axes and needs write_maps before. `stem` is the prefix of the files' names.
std::string pigment_sdl(const SceneDescription& scene, const Colour& colour, const std::string& stem,
                        PovUv uv = PovUv::flat);

/// The name that write_maps declares for a texture: a pigment's colour as a function of (u, v, 0).
std::string map_name(TextureIndex texture);
std::string map_declaration(const SceneDescription& scene, TextureIndex texture, const std::string& stem);

/// A pigment whose channels, at most `greatest`, are those of a declared map at these places. A filter transmits light
/// by them.
std::string mapped_pigment(TextureIndex texture, const std::string& u, const std::string& v, double greatest,
                           bool filter);

/// " matrix<...>" of a transform; POV-Ray multiplies row vectors, so that its rows are the images of the axes.
std::string matrix_sdl(const Transform& to, double scale = 1);

/// The visible sky where no surface is: a background, a sky_sphere or a distant ball. Its radiance is multiplied by
/// `exposure`, lengths by `scale`.
std::string sky_sdl(const PovScene& scene, double exposure, double scale, const std::string& stem);

/// The files that surfaces and the sky need.
std::vector<PovFile> image_files(const PovScene& scene, double exposure, const std::string& stem);

}  // namespace photonproof::inline reference_povray
