// The scene as a tracer of one path at a time sees it, for the scalar integrators (volpath, bdpt, ptracer, whitted).
// With the batched kernels they share the formulas of BSDFs and lights and the ray queries, but no code that makes
// paths. Directions are unit, in world space, and point away from the surface: wo to the path's origin, wi to its next
// vertex. Throughout, ng is the geometric normal and the normal of `scattering`'s frame is for shading.
#pragma once

#include <optional>

#include "renderer/bsdfs/scattering.h"
#include "renderer/core/ray_counts.h"
#include "renderer/lanes/warp.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_scalar {

struct Ray {
  Vec3f origin, direction;        ///< direction: unit
  std::uint32_t from = no_index;  ///< primitive that it leaves, in a small scene
  float gap = 0;                  ///< distance of its origin from the surface it leaves

  Vec3f start() const { return origin - direction * gap; }  ///< on the surface
  /// Distance of a point ahead from the surface: the length that media on the way count.
  float way_to(const Vec3f& p) const { return length(p - origin) + gap; }
};

/// A point of a surface with all data for scattering.
struct Interaction {
  Vec3f p, ng;
  Scattering<float> scattering{Frame<float>(Vec3f(0, 0, 1))};
  float u_choice = 0;  ///< as passed to `intersect`
  std::uint32_t surface = no_index;
  std::uint32_t primitive = no_index;  ///< as in SurfaceHit
  std::uint32_t light = no_index;
  std::uint32_t leaf = 0;  ///< index into Scene::bsdfs
  Bsdf bsdf;               ///< the BSDF with that index, with texture values
};

/// One end of a segment: a point, and the primitive and normal it lies on, if any.
struct SegmentEnd {
  Vec3f p;
  Vec3f normal{0, 0, 0};
  std::uint32_t primitive = no_index;
  std::uint32_t surface = no_index;
  bool at_infinity = false;  ///< p stands only for a direction
};
inline SegmentEnd end_at(const Interaction& at) { return {at.p, at.ng, at.primitive, at.surface}; }

/// Result of sampling a direction at a surface; world space.
struct Scattered {
  Vec3f wi;
  Rgb weight;     ///< f cos / pdf, the cosine as in Scattering
  float pdf = 0;  ///< per solid angle; of a delta lobe its probability
  float eta = 1;  ///< ior of the side entered / ior of the side left
  bool delta = false;
  bool straight = false;  ///< goes straight on through the surface, unchanged
  bool valid = false;     ///< else the path is absorbed
};

class SceneInterface {
 public:
  explicit SceneInterface(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const SceneView& view() const { return scene_.view(); }
  /// Whether paths must track the media and interiors that they travel through (surroundings.h).
  bool has_media_or_interiors() const { return has_media_or_interiors_; }
  /// Whether some surface lets light go straight on.
  bool has_null_surfaces() const { return has_null_surfaces_; }
  /// Twice the largest distance between two points of the scene.
  float far_away() const { return far_away_; }

  /// The closest surface; false when there is none. `u_choice` in [0,1) decides among the layers of a surface that is
  /// several at once. `mode` is whether the ray comes from the camera or a light.
  bool intersect(const Ray& ray, float u_choice, TransportMode mode, Interaction& hit) const;
  /// A light path's vertex as seen along `to_camera`, since maps may show another normal there: the vertex itself, or
  /// `other`, which the function then fills.
  const Interaction& seen_from(const Interaction& at, const Vec3f& to_camera, Interaction& other) const;
  /// Whether no surface lies strictly between two points.
  bool visible(const SegmentEnd& from, const SegmentEnd& to) const;
  /// The ray that leaves a point along `direction`.
  Ray leave(const SegmentEnd& at, const Vec3f& direction) const;
  Ray leave(const Interaction& at, const Vec3f& direction) const { return leave(end_at(at), direction); }
  /// The ray that continues behind a surface which `ray` met and passes. It starts farther along `direction` than `ray`
  /// did, even where coordinates are so coarse that the usual offset would not leave the surface. So a path straight
  /// from surface to surface always comes to its end.
  Ray pass(const Ray& ray, const Interaction& at, const Vec3f& direction) const;

 private:
  void look_closer(const Vec3f& direction, TransportMode mode, Interaction& hit) const;

  const Scene& scene_;
  float far_away_;
  bool has_media_or_interiors_, has_null_surfaces_;
};

/// f of radiance that arrives along `to_light` and leaves along `to_camera`, times the cosine in the weight of a path
/// of that mode (Scattering::cosine); smooth part alone.
Rgb evaluate(const Interaction& at, const Vec3f& to_camera, const Vec3f& to_light, TransportMode mode);
/// Density per solid angle with which `scatter` samples wi when the path came from wo; smooth part alone.
float scatter_pdf(const Interaction& at, const Vec3f& wo, const Vec3f& wi, TransportMode mode);
Scattered scatter(const Interaction& at, const Vec3f& wo, float u_lobe, const Vec2<float>& u_direction,
                  TransportMode mode);

/// Share of light along -wo that goes straight on; empty where the surface scatters all.
std::optional<Rgb> straight_through(const Interaction& at, const Vec3f& wo);

inline float cosine(const Vec3f& normal, const Vec3f& direction) { return std::abs(dot(normal, direction)); }

}  // namespace photonproof::inline renderer_scalar
