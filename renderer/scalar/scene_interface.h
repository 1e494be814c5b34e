// The scene as one path at a time sees it: what the scalar integrators (volpath, bdpt, ptracer, whitted) ask. With
// the batched kernels they share the formulas of BSDFs and lights and the ray queries, but nothing of how paths are
// made. Directions are unit, in world space, and point away from the surface: wo where the path came from, wi where
// it goes on. Throughout, ng is the geometric normal and the one of `scattering`'s frame the one that shades.
#pragma once

#include <optional>

#include "renderer/bsdfs/scattering.h"
#include "renderer/core/ray_counts.h"
#include "renderer/lanes/warp.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_scalar {

struct Ray {
  Vec3f origin, direction;        ///< direction: unit
  std::uint32_t from = no_index;  ///< primitive it leaves, of a small scene
  float gap = 0;                  ///< from the surface it leaves to its origin, which was moved off it

  /// Of a point ahead, from the surface: what media on the way count.
  float way_to(const Vec3f& p) const { return length(p - origin) + gap; }
};

/// A point of a surface, with all that scattering needs.
struct Interaction {
  Vec3f p, ng;
  Scattering<float> scattering{Frame<float>(Vec3f(0, 0, 1))};
  float u_choice = 0;  ///< as `intersect` had it
  std::uint32_t surface = no_index;
  std::uint32_t primitive = no_index;  ///< as SurfaceHit has it
  std::uint32_t light = no_index;
  std::uint32_t leaf = 0;  ///< index into Scene::bsdfs
  Bsdf bsdf;               ///< that one, with what textures say
};

/// One end of a segment: a point, and the primitive and normal it lies on, if any.
struct SegmentEnd {
  Vec3f p;
  Vec3f normal{0, 0, 0};
  std::uint32_t primitive = no_index;
  std::uint32_t surface = no_index;
  bool at_infinity = false;  ///< p only stands for a direction
};
inline SegmentEnd end_at(const Interaction& at) { return {at.p, at.ng, at.primitive, at.surface}; }

/// What drawing a direction at a surface gave; world space.
struct Scattered {
  Vec3f wi;
  Rgb weight;     ///< f cos / pdf, the cosine as Scattering has it
  float pdf = 0;  ///< per solid angle; of a delta lobe its probability
  float eta = 1;  ///< ior of the side entered / ior of the side left
  bool delta = false;
  bool straight = false;  ///< through what lets light go straight on, as if nothing were there
  bool valid = false;     ///< else the path is absorbed
};

class SceneInterface {
 public:
  explicit SceneInterface(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const SceneView& view() const { return scene_.view(); }
  /// Whether paths must know what they travel through (surroundings.h).
  bool has_media_or_bodies() const { return has_media_or_bodies_; }
  /// Whether some surface lets light go straight on.
  bool has_null_surfaces() const { return has_null_surfaces_; }
  /// Twice as far as any two points of the scene are apart.
  float far_away() const { return far_away_; }

  /// The closest surface; false when there is none. `u_choice` in [0,1) decides among the layers of a surface that is
  /// several at once, `mode` says whether the ray comes from the camera or a light.
  bool intersect(const Ray& ray, float u_choice, TransportMode mode, Interaction& hit) const;
  /// A light path's vertex as it is when seen along `to_camera`, since maps may show another normal there: itself, or
  /// what is put in `other`.
  const Interaction& seen_from(const Interaction& at, const Vec3f& to_camera, Interaction& other) const;
  /// Whether nothing lies strictly between two points.
  bool visible(const SegmentEnd& from, const SegmentEnd& to) const;
  /// The ray that leaves a point along `direction`.
  Ray leave(const SegmentEnd& at, const Vec3f& direction) const;
  Ray leave(const Interaction& at, const Vec3f& direction) const { return leave(end_at(at), direction); }
  /// The ray that goes on behind a surface which `ray` met and passes. It starts farther along `direction` than `ray`
  /// did, even where coordinates are so coarse that moving off the surface does not get there: who follows a straight
  /// way from surface to surface comes to its end.
  Ray pass(const Ray& ray, const Interaction& at, const Vec3f& direction) const;

 private:
  void look_closer(const Vec3f& direction, TransportMode mode, Interaction& hit) const;

  const Scene& scene_;
  float far_away_;
  bool has_media_or_bodies_, has_null_surfaces_;
};

/// f of radiance that arrives along `to_light` and leaves along `to_camera`, times the cosine that a path of that
/// mode has in its weight (Scattering::cosine); smooth part alone.
Rgb evaluate(const Interaction& at, const Vec3f& to_camera, const Vec3f& to_light, TransportMode mode);
/// Density per solid angle with which `scatter` draws wi when the path came from wo; smooth part alone.
float scatter_pdf(const Interaction& at, const Vec3f& wo, const Vec3f& wi, TransportMode mode);
Scattered scatter(const Interaction& at, const Vec3f& wo, float u_lobe, const Vec2<float>& u_direction,
                  TransportMode mode);

/// What goes straight on, of light that travels along -wo; nothing where the surface scatters all.
std::optional<Rgb> straight_through(const Interaction& at, const Vec3f& wo);

inline float cosine(const Vec3f& normal, const Vec3f& direction) { return std::abs(dot(normal, direction)); }

}  // namespace photonproof::inline renderer_scalar
