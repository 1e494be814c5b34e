// The compiled scene: flat tables ready for tracing, made once and immutable. Its origin is the middle of the shapes,
// so that coordinates are small and rays precise for any place in the file. In its unit of length single precision can
// square and cube all lengths.
#pragma once

#include <memory>
#include <vector>

#include "renderer/light_sampling/clear_ways.h"
#include "renderer/light_sampling/light_words.h"
#include "renderer/rays/trace.h"
#include "renderer/scene/scene_choices.h"
#include "renderer/scene/scene_parts.h"
#include "renderer/scene/scene_view.h"
#include "renderer/scene/surface_detail.h"

namespace photonproof::inline renderer_light_sampling {
class SceneLights;
}
namespace photonproof::inline renderer_rays {
class BruteForceTables;
}

namespace photonproof::inline renderer_scene {

/// The parts with everything needed to trace rays among them.
class Scene : public SceneParts {
 public:
  /// `choices` are a plan's for these parts.
  Scene(SceneParts parts, const SceneChoices& choices);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Tables of the kernels; valid as long as the scene.
  const SceneView& view() const { return view_; }
  /// All lights behind one interface.
  const SceneLights& scene_lights() const { return *scene_lights_; }
  /// Closest surface along a ray with a unit direction: for the host's few own rays.
  Hit intersect(const Vec3f& origin, const Vec3f& direction) const;
  /// Bytes of geometry and tables, the description's meshes included, Embree's hierarchy not.
  std::size_t memory_bytes() const;

 private:
  SceneView view_of(const SceneChoices& choices) const;

  // Each is made from those before it.
  const std::unique_ptr<const BruteForceTables> small_;  ///< null where rays go through the tracer
  const std::unique_ptr<const Tracer> tracer_;           ///< null in a small scene
  const std::vector<SurfaceWords> surface_words_;
  const std::vector<float> bsdf_records_, light_records_;
  const std::vector<LightWords> light_words_;
  const std::vector<ProjectionTarget> projection_targets_;
  const ClearWays clear_ways_;
  const DetailTables detail_;
  const std::unique_ptr<SceneLights> scene_lights_;
  SceneView view_;
};

}  // namespace photonproof::inline renderer_scene
