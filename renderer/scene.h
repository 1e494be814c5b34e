// The compiled scene: flat tables ready for tracing, made once from a SceneDescription and immutable. Its origin is the
// middle of the shapes, so that coordinates are small and rays precise wherever the file puts things.
#pragma once

#include <memory>
#include <vector>

#include "renderer/bsdf.h"
#include "renderer/camera.h"
#include "renderer/light.h"
#include "renderer/medium.h"
#include "renderer/scene_view.h"
#include "renderer/skips.h"
#include "renderer/surface.h"
#include "renderer/trace.h"
#include "scenes/description.h"

namespace photonproof {

class SmallSceneTables;

/// Up to this many primitives are tested one after the other instead of through Embree. Measured among random
/// parallelograms (rays_bench.cpp, "threshold"): at 128 the packed kernel is 1.8, 1.4 and 0.9 times as fast with 16, 8
/// and 4 lanes, and Embree does better than there where primitives do not overlap.
inline constexpr std::size_t small_scene_limit = 128;

class Scene {
 public:
  /// `width`, `height` override the film's size; at most `small_limit` primitives make a small scene. Throws InputError
  /// at an entity it cannot represent.
  Scene(const SceneDescription& description, int width, int height, const SkipSwitches& skips = {},
        std::size_t small_limit = small_scene_limit);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Tables of the kernels; valid as long as the scene.
  const SceneView& view() const { return view_; }
  /// Closest surface along a ray with a unit direction: for the host's few own rays.
  Hit intersect(const Vec3f& origin, const Vec3f& direction) const;

  /// Parallelograms, spheres and triangles.
  std::size_t primitive_count() const { return primitives_; }
  /// Bytes of geometry and tables, the description's meshes included, Embree's hierarchy not.
  std::size_t memory_bytes() const;

  const int width, height;
  std::vector<Bsdf> bsdfs;
  std::vector<Light> lights;
  std::vector<Surface> surfaces;
  SceneMedia media;

 private:
  void add_shape(const SceneDescription& description, const ShapeDescription& shape);
  void add_surface(Geometry geometry, const ShapeDescription& shape);
  void add_mesh(const SceneDescription& description, const ShapeDescription& shape, const MeshDescription& ply,
                const Transform& to_world);
  void add_quad(const ShapeDescription& shape, const Transform& face_to_world);

  Vec3d moved_;  ///< what was added to the description's coordinates
  std::size_t primitives_ = 0;
  std::vector<SurfaceWords> surface_words_;
  std::vector<LightWords> light_words_;
  std::vector<float> bsdf_records_, light_records_;
  std::vector<AimTarget> aim_targets_;
  std::unique_ptr<SmallSceneTables> small_;
  std::unique_ptr<Tracer> tracer_;
  SceneView view_;
};

}  // namespace photonproof
