// Where on a light that is huge for its distance light paths start. Started evenly, hardly any would come near what is
// looked at: of a light of half-size S over a place of size r a share (r/S)^2. So half of the paths from such a light
// are started as next-event estimation would find them from one of some places that the camera sees, and half of those
// are sent into the ball around it (aim.h). With V places v and their balls, x the start and w the direction,
//   p(x, w) = 1/2 cos/(pi A) + 1/(2V) sum over v of p(x | v) (1/2 cos/pi + 1/2 p_ball(w | x))
// Half of the paths start evenly, as every place may matter: no weight is more than twice what it would be without.
// A place is looked at from a distance from the light that is at least its ball's radius, so that the starts spread
// over all that lights the ball.
//
// A light that is far away for the size of what is looked at, of which evenly started paths hit next to nothing, starts
// them evenly and sends that half of them into the balls:
//   p(x, w) = 1/2 1/A cos/pi + 1/(2V) sum over v of 1/A p_ball(w | x)
// Directions in single precision miss a ball from a million times its radius on. Such a path is known by its line,
// which goes through a point of the ball, and its ray begins where it has met nothing yet.
//
// Light from infinity starts evenly on the disc across the ball around the scene, of radius R. Where that is large for
// the places, half of the paths start on the disc across one of their balls, whose radius is r; d is the distance of
// v's middle from the path's line:
//   p(x | w) = 1/2 1/(pi R^2) + 1/(2V) sum over v of [d < r] / (pi r^2)
#pragma once

#include <optional>
#include <vector>

#include "renderer/light_sampling/clear_ways.h"
#include "renderer/lights/light.h"
#include "renderer/shapes/scene_ball.h"

namespace photonproof::inline renderer_light_sampling {

/// A start of a light path; what it carries is left to the caller.
struct GuidedStart {
  LightPoint<float> at;
  Vec3f direction{0, 0, 1};
  Vec3f on_line;                    ///< a point of the path's line, as near what is looked at as is known
  std::optional<Vec3f> ahead = {};  ///< as of an Emission
};

class EmissionGuiding {
 public:
  EmissionGuiding() = default;
  /// `seen`: balls of what the camera sees. Lights that are neither huge for their distance to any nor far away are
  /// left alone. `ways`, if known, outlive this.
  EmissionGuiding(const std::vector<Light>& lights, const std::vector<ProjectionTarget>& seen, const SceneBall& scene,
                  const ClearWays* ways = nullptr);

  bool empty() const { return guided_ == 0; }
  bool guides(std::uint32_t light) const { return light < views_.size() && !views_[light].empty(); }
  /// Nothing where the place drawn does not see the light. `light` is what `lights` has at `index`, which is guided.
  std::optional<GuidedStart> start(const Light& light, std::uint32_t index, const Vec2<float>& u_position,
                                   const Vec2<float>& u_direction) const;
  /// Densities of that; `even`: what they are without a guide.
  EmissionPdfs<float> pdfs(const Light& light, std::uint32_t index, const LightPoint<float>& at,
                           const AimedLine<float>& line, const EmissionPdfs<float>& even) const;

 private:
  struct Aov {
    Vec3f from;
    ProjectionTarget ball;
    bool is_far = false;  ///< starts are even
  };
  /// Sends it into the ball.
  void aim(std::uint32_t light, const ProjectionTarget& ball, const Vec2<float>& u, GuidedStart& start) const;
  GuidedStart start_far(const Light& light, const ProjectionTarget& ball, const Vec2<float>& u_position,
                        const Vec2<float>& u_direction) const;

  SceneBall scene_;
  const ClearWays* ways_ = nullptr;
  std::vector<std::vector<Aov>> views_;  ///< of each light
  std::size_t guided_ = 0;               ///< lights with views
};

}  // namespace photonproof::inline renderer_light_sampling
