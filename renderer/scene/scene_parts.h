// The tables to which a scene description compiles before a plan exists or anything is built to trace it. Plans are
// made from these tables, and a Scene contains them.
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
  SceneFrame frame;  ///< maps the description's coordinates
  ReconstructionFilter filter;
  bool sample_border;
  CameraView camera;
  std::shared_ptr<const std::vector<CameraView>> camera_parts;  ///< of a batch; `camera` points to them
  std::shared_ptr<const Textures> textures;
  SceneMedia media;
  BsdfTable bsdfs;
  std::vector<Surface> surfaces;
  std::vector<ShapeBox> boxes;       ///< Around each surface; empty around infinite ones.
  std::vector<std::size_t> cubes;    ///< The first of the six surfaces of each.
  std::vector<AffineMap> uv_frames;  ///< Indexed by Surface::uv_frame.
  std::size_t primitives = 0;  ///< Number over all shapes. Those of a shape group count once, and each instance as one.
  bool simple_primitives = true;  ///< Parallelograms, triangles and spheres only, as the packed kernel requires.
  SceneBall ball;
  std::vector<Light> lights;                ///< Lights of the shapes' surfaces, then the emitters.
  std::vector<double> light_probabilities;  ///< The choice of each light; empty: by flux or place.
  std::vector<char> plain;         ///< Per surface: hits need no more than its BSDF record and geometric normal.
  std::uint32_t bsdf_kinds = 0;    ///< Bit k: a surface has a BSDF of kind k.
  bool lights_can_be_hit = false;  ///< A ray may meet one.
  RoughLimit rough_limit{};        ///< Roughness from which photons are gathered by direction.

  /// Factor from lengths of the description to lengths of the scene: 1, or a power of two where lengths would be far
  /// too small or large.
  double scale() const { return frame.scale; }
};

}  // namespace photonproof::inline renderer_scene
