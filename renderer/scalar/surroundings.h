// The surroundings of a path: a medium, and the bodies of glass it is inside of, which may overlap. In an overlap only
// the body with the highest priority counts (Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images").
// Among equals it is the one entered first.
#pragma once

#include <array>
#include <optional>

#include "renderer/lanes/path_sampler.h"
#include "renderer/media/medium.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_scalar {

/// Effect of crossing a surface.
struct Crossing {
  bool is_boundary = true;   ///< false: hidden by a body that takes precedence on both sides; rays go straight on
  std::optional<float> eta;  ///< interior over exterior ior there, where priorities decide it
};

class Surroundings {
 public:
  Surroundings() = default;
  explicit Surroundings(std::uint32_t medium) : medium_(medium) {}

  /// Index into SceneMedia::media, or no_index.
  std::uint32_t medium() const { return medium_; }

  /// Sets a surface's dielectric to the indices on both its sides there.
  static void refract_as(const Crossing& crossing, Interaction& at);

  /// The crossing of the surface by a ray along `direction`.
  Crossing crossing(const SceneInterface& scene, const Interaction& at, const Vec3f& direction) const;
  /// Goes through the surface to the side `direction` points to.
  void cross(const SceneInterface& scene, const Interaction& at, const Vec3f& direction);
  /// The same for a path that came from wo: nothing changes if that is on the same side.
  void leave(const SceneInterface& scene, const Interaction& at, const Vec3f& wo, const Vec3f& wi);

 private:
  static constexpr std::size_t max_interiors = 8;  ///< beyond this depth the bodies entered last do not count
  struct Interior {
    std::uint32_t bsdf, medium;
    int priority;
    int entered;  ///< times entered without having left
  };
  const Interior* top() const;
  void enter(std::uint32_t bsdf, std::uint32_t medium, int priority);
  void exit(std::uint32_t bsdf);

  std::uint32_t medium_ = no_index;
  std::size_t count_ = 0;
  std::array<Interior, max_interiors> interiors_;
};

/// The medium far outside: the camera's, unless a boundary lies between.
std::uint32_t outer_medium(const SceneInterface& scene);
/// Transmittance of an endless medium for light paths that start at infinity; 1 for other light paths.
Rgb arriving_from_infinity(const SceneInterface& scene, bool from_infinity, std::uint32_t outer);
/// The surroundings at p, found by following a ray there from far outside. Boundaries of media and bodies must be
/// closed.
Surroundings surroundings_at(const SceneInterface& scene, const Vec3f& p, std::uint32_t outer);

/// Surfaces that do not end a segment: `null` for those that let light go straight on, attenuated, and lights.
struct Passing {
  bool null = false, lights = false;
};

/// Share of the light that arrives from one point at another: 0 where a surface is in the way, else the rest after
/// absorption and scattering by media. `surroundings` are those of the segment's start; `draws` decides among layers,
/// from `dimension` on.
Rgb transmittance(const SceneInterface& scene, const SegmentEnd& from, const SegmentEnd& to, Surroundings surroundings,
                  const Passing& through, const PathSampler& draws, std::uint32_t dimension);

/// Finds the next surface that counts, and multiplies `throughput` by the transmittance of absorbing media on the way.
/// `ray` and `surroundings` are those of the last step, of a path of that mode. False when there is none.
bool travel(const SceneInterface& scene, Ray& ray, Surroundings& surroundings, float u_layer, TransportMode mode,
            Rgb& throughput, Interaction& at);

}  // namespace photonproof::inline renderer_scalar
