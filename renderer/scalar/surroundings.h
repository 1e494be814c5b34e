// What a path travels through: a medium, and the bodies of glass it is inside of, which may overlap. Where they do,
// the one with the highest priority is there and the others are not (Schmidt and Budge 2002, "Simple Nested Dielectrics
// in Ray Traced Images"); among equals the one entered first.
#pragma once

#include <array>
#include <optional>

#include "renderer/lanes/path_sampler.h"
#include "renderer/media/medium.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_scalar {

/// What a crossing of a surface means.
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

  /// Turns a surface's dielectric to the indices on both its sides there.
  static void refract_as(const Crossing& crossing, Interaction& at);

  /// What a ray along `direction` finds at the surface.
  Crossing crossing(const SceneInterface& world, const Interaction& at, const Vec3f& direction) const;
  /// Goes through the surface to the side `direction` points to.
  void cross(const SceneInterface& world, const Interaction& at, const Vec3f& direction);
  /// The same where it came from wo: nothing changes if that is the same side.
  void leave(const SceneInterface& world, const Interaction& at, const Vec3f& wo, const Vec3f& wi);

 private:
  static constexpr std::size_t most_bodies = 8;  ///< inside of more, the last entered do not count
  struct Body {
    std::uint32_t bsdf, medium;
    int priority;
    int entered;  ///< times, without having left
  };
  const Body* top() const;
  void enter(std::uint32_t bsdf, std::uint32_t medium, int priority);
  void exit(std::uint32_t bsdf);

  std::uint32_t medium_ = no_index;
  std::size_t count_ = 0;
  std::array<Body, most_bodies> bodies_;
};

/// The medium far outside, where the camera's is unless a border lies between.
std::uint32_t outer_medium(const SceneInterface& world);
/// What a medium without end leaves of light paths that start at infinity; of others it is 1.
Rgb arriving_from_infinity(const SceneInterface& world, bool from_infinity, std::uint32_t outer);
/// What is at p, found by following a ray there from far outside. Borders of media and bodies are taken to be closed.
Surroundings surroundings_at(const SceneInterface& world, const Vec3f& p, std::uint32_t outer);

/// Surfaces that do not end a segment: those that let light go straight on, with what they let through, and lights.
struct Passing {
  bool null = false, lights = false;
};

/// Which part of the light that goes from one point to another arrives: 0 where a surface is in the way, else what the
/// media absorb and scatter away leaves. `surroundings` are those of the segment's start; `draws` decide among layers,
/// from `dimension` on.
Rgb transmittance(const SceneInterface& world, const SegmentEnd& from, const SegmentEnd& to, Surroundings surroundings,
                  const Passing& through, const PathSampler& draws, std::uint32_t dimension);

/// The next surface that is there, and what absorbing media leave of `throughput` on the way. `ray` and `surroundings`
/// are those of the last step, of a path of that mode. False when there is none.
bool travel(const SceneInterface& world, Ray& ray, Surroundings& surroundings, float u_layer, TransportMode mode,
            Rgb& throughput, Interaction& at);

}  // namespace photonproof::inline renderer_scalar
