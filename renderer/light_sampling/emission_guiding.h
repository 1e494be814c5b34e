// Starts of light paths on lights that are huge relative to their distance. With even starts hardly any path would come
// near the visible scene: for a light of half-size S and a place of size r, a share (r/S)^2. So half of the paths from
// such a light start at points that next-event estimation would sample. The receiving points are some places that the
// camera sees. Half of those paths are sent into the ball around the place (projection_cone.h). With V places v and
// their balls, x the start and w the direction,
//   `p(x, w) = 1/2 cos/(pi A) + 1/(2V) sum over v of p(x | v) (1/2 cos/pi + 1/2 p_ball(w | x))`.
// The other half of the paths starts evenly, as every place may matter: no weight is more than twice that without
// guiding. The sampling point for a place is at least its ball's radius from the light. The starts thus spread over all
// of the light that illuminates the ball.
//
// A light may be far away compared to the visible scene, so that evenly started paths hardly ever hit the scene. All
// its starts are even, and half of the paths are sent into the balls.
//   `p(x, w) = 1/2 1/A cos/pi + 1/(2V) sum over v of 1/A p_ball(w | x)`.
// Directions in single precision miss a ball beyond a million times its radius. Such a path is known by its line, which
// goes through a point of the ball. Its ray begins at the point up to which it meets nothing.
//
// Light from infinity starts evenly on the disc across the ball around the scene, of radius R. Where that is large
// compared to the places, half of the paths start on the disc across one of their balls, of radius r. The distance of
// v's middle from the path's line is d.
//   `p(x | w) = 1/2 1/(pi R^2) + 1/(2V) sum over v of [d < r] / (pi r^2)`.
#pragma once

#include <optional>
#include <vector>

#include "renderer/light_sampling/clear_ways.h"
#include "renderer/lights/light.h"
#include "renderer/shapes/scene_ball.h"

namespace photonproof::inline renderer_light_sampling {

/// Start of a light path; the caller computes its flux.
struct GuidedStart {
  LightPoint<float> at;
  Vec3f direction{0, 0, 1};
  Vec3f on_line;                    ///< point of the path's line, as near to the target as known
  std::optional<Vec3f> ahead = {};  ///< as in Emission
};

class EmissionGuiding {
 public:
  EmissionGuiding() = default;
  /// The balls `seen` cover the visible scene. Lights that are neither huge nor far away for any of them are not
  /// guided. `ways`, if given, must outlive this object.
  EmissionGuiding(const std::vector<Light>& lights, const std::vector<ProjectionTarget>& seen, const SceneBall& scene,
                  const ClearWays* ways = nullptr);

  bool empty() const { return guided_ == 0; }
  bool guides(std::uint32_t light) const { return light < views_.size() && !views_[light].empty(); }
  /// Empty where the chosen place does not see the light. `light` is `lights[index]` of the constructor, a guided
  /// light.
  std::optional<GuidedStart> start(const Light& light, std::uint32_t index, const Vec2<float>& u_position,
                                   const Vec2<float>& u_direction) const;
  /// Densities of such a start; `even` holds those without a guide.
  EmissionPdfs<float> pdfs(const Light& light, std::uint32_t index, const LightPoint<float>& at,
                           const AimedLine<float>& line, const EmissionPdfs<float>& even) const;

 private:
  struct Aov {
    Vec3f from;
    ProjectionTarget ball;
    bool is_far = false;  ///< true for even starts
  };
  /// Changes the direction to lead into the ball.
  void aim(std::uint32_t light, const ProjectionTarget& ball, const Vec2<float>& u, GuidedStart& start) const;
  GuidedStart start_far(const Light& light, const ProjectionTarget& ball, const Vec2<float>& u_position,
                        const Vec2<float>& u_direction) const;

  SceneBall scene_;
  const ClearWays* ways_ = nullptr;
  std::vector<std::vector<Aov>> views_;  ///< views of each light
  std::size_t guided_ = 0;               ///< lights with views
};

}  // namespace photonproof::inline renderer_light_sampling
