// What a scene description compiles to before anything is decided about it or built to trace it: plans are made from
// these tables, and a Scene has them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/bsdfs/bsdf_table.h"
#include "renderer/lights/light.h"
#include "renderer/media/medium.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/sensor/camera.h"
#include "renderer/shapes/scene_ball.h"
#include "renderer/shapes/surface.h"
#include "renderer/textures/texture.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

struct SceneParts {
  /// `width`, `height` override the film's size. Throws InputError at an entity it cannot represent.
  SceneParts(const SceneDescription& description, int width, int height);

  int width, height;
  SceneFrame frame;  ///< how coordinates come from the description's
  ReconstructionFilter filter;
  bool sample_border;
  CameraView camera;
  std::shared_ptr<const Textures> textures;
  SceneMedia media;
  BsdfTable bsdfs;
  std::vector<Surface> surfaces;
  std::vector<ShapeBox> boxes;       ///< around each surface; empty around infinite ones
  std::vector<std::size_t> cubes;    ///< the first of the six surfaces of each
  std::vector<AffineMap> uv_frames;  ///< by Surface::uv_frame
  std::size_t primitives = 0;        ///< of all shapes; those of a shape group count once, and each instance as one
  bool simple_primitives = true;     ///< parallelograms, triangles and spheres only: what the packed kernel knows
  SceneBall ball;
  std::vector<Light> lights;       ///< of the shapes' surfaces, then the emitters
  std::vector<char> plain;         ///< by surface: hits need no more than its BSDF record and geometric normal
  std::uint32_t bsdf_kinds = 0;    ///< bit k: a surface has a BSDF of kind k
  bool lights_can_be_hit = false;  ///< by a ray
  RoughLimit rough_limit{};        ///< from where on photons are looked up by direction

  /// A length of the description times this is one of the scene: 1, or a power of two where that would be all too small
  /// or large.
  double scale() const { return frame.scale; }
};

}  // namespace photonproof::inline renderer_scene
