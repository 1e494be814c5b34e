// The compiled scene: flat tables ready for tracing, made once from a SceneDescription and immutable. Its origin is the
// middle of the shapes, so that coordinates are small and rays precise wherever the file puts things, and its unit of
// length one that single precision can square and cube.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/core/skips.h"
#include "renderer/lights/light.h"
#include "renderer/media/medium.h"
#include "renderer/rays/trace.h"
#include "renderer/scene/scene_view.h"
#include "renderer/scene/surface_detail.h"
#include "renderer/sensor/camera.h"
#include "renderer/shapes/surface.h"
#include "scenes/description/description.h"

namespace photonproof {

class SceneLights;
class SceneShapes;
class SmallSceneTables;

/// Up to this many primitives are tested one after the other instead of through Embree. Measured among random
/// parallelograms (rays_bench.cpp, "threshold"): at 128 the packed kernel is 1.8, 1.4 and 0.9 times as fast with 16, 8
/// and 4 lanes, and Embree does better than there where primitives do not overlap.
inline constexpr std::size_t small_scene_limit = 128;
/// The same for integrators that trace one ray at a time: bdpt on `cornell` (12 parallelograms) is 1.4 times as fast
/// through Embree, on `cornell-spheres` (8 primitives) as fast.
inline constexpr std::size_t small_scene_limit_of_single_rays = 8;

/// A scene that is only planned has no hierarchy and cannot be traced.
enum class ScenePurpose { render, plan };

class Scene {
 public:
  /// `width`, `height` override the film's size; at most `small_limit` primitives make a small scene. Throws InputError
  /// at an entity it cannot represent.
  Scene(const SceneDescription& description, int width, int height, const SkipSwitches& skips = {},
        std::size_t small_limit = small_scene_limit, ScenePurpose purpose = ScenePurpose::render);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Tables of the kernels; valid as long as the scene.
  const SceneView& view() const { return view_; }
  /// All lights behind one interface.
  const SceneLights& scene_lights() const { return *scene_lights_; }
  /// A length of the description times this is one of the scene: 1, or a power of two where that would be all too small
  /// or large (scene_frame.h).
  double scale() const { return scale_; }
  /// Closest surface along a ray with a unit direction: for the host's few own rays.
  Hit intersect(const Vec3f& origin, const Vec3f& direction) const;

  /// Of all shapes; those of a shape group count once, and each instance as one.
  std::size_t primitive_count() const { return primitives_; }
  /// Bytes of geometry and tables, the description's meshes included, Embree's hierarchy not.
  std::size_t memory_bytes() const;

  /// Whether all primitives are parallelograms, triangles and spheres: what the packed kernel knows.
  bool has_simple_primitives() const { return simple_; }
  /// Whether hits need more than their surface's BSDF record and geometric normal (surface_detail.h).
  bool needs_detail() const { return needs_detail_; }

  /// Calls visit(const Bsdf&, bool textured) for every BSDF that a hit on a surface with this one may get.
  template <class Visit>
  void for_each_leaf(std::uint32_t bsdf, Visit&& visit) const {
    photonproof::for_each_leaf(detail_.tree, bsdf, detail_.nothing,
                               [&](std::uint32_t leaf) { visit(bsdfs[leaf], !detail_.tree[leaf].slots.empty()); });
  }
  /// Whether the BSDF wraps no other.
  bool is_leaf(std::uint32_t bsdf) const { return detail_.tree[bsdf].kind == BsdfNode::Kind::leaf; }

  const int width, height;
  const Textures textures;
  std::vector<Bsdf> bsdfs;  ///< by the description's indices; of those that wrap others there is nothing here
  std::vector<Light> lights;
  std::vector<Surface> surfaces;
  const SceneMedia media;
  const ReconstructionFilter filter;

 private:
  struct Framed;
  Scene(const Framed& framed, int width, int height, const SkipSwitches& skips, std::size_t small_limit,
        ScenePurpose purpose);
  void compile_bsdfs(const SceneDescription& description);
  void refuse_deep_maps(const SceneDescription& description) const;
  void add_surface_lights(const SceneDescription& description, const SceneShapes& shapes);
  void compile_detail(const SkipSwitches& skips);

  double scale_ = 1;
  Vec3d moved_;  ///< what was added to the description's coordinates, scaled
  std::size_t primitives_ = 0;
  bool simple_ = true, needs_detail_ = false;
  std::vector<SurfaceWords> surface_words_;
  std::vector<LightWords> light_words_;
  std::vector<float> bsdf_records_, light_records_;
  std::vector<AimTarget> aim_targets_;
  std::unique_ptr<SceneLights> scene_lights_;
  DetailTables detail_;
  std::unique_ptr<SmallSceneTables> small_;
  std::unique_ptr<Tracer> tracer_;
  SceneView view_;
};

}  // namespace photonproof
