// The scene's lights for a pack: choosing one, a point on it, and the density with which a point would be sampled.
#pragma once

#include <cstring>

#include "renderer/kernels/general_lights.h"
#include "renderer/lanes/lane.h"
#include "renderer/light_sampling/light_sampling.h"
#include "renderer/lights/light_kinds.h"
#include "renderer/rays/surface_hit.h"
#include "renderer/scene/scene_view.h"

namespace photonproof::inline renderer_kernels {

inline bool has_general_lights(const SceneView& scene) { return (scene.light_kinds >> general_light_kind & 1u) != 0; }

/// The record of a chosen light. A single light is the same in every lane, so it needs no gather.
template <template <class> class Kind, class F>
Kind<F> light_record(const SceneView& scene, const UInt<F>& light) {
  if (!scene.one_light) return gather_record<Kind, F>(scene.lights, light, LightKinds::stride);
  constexpr std::size_t words = sizeof(Kind<float>) / sizeof(float);
  F columns[words];
  for (std::size_t k = 0; k < words; ++k) columns[k] = F(scene.lights[k]);
  Kind<F> record;
  std::memcpy(&record, columns, sizeof record);
  return record;
}

/// Calls visit(light of F, lanes of that kind) for the kinds that occur among the active lanes' lights. Lights that
/// need tables are one kind, GeneralLight.
template <class F, class Visit>
void for_each_light_kind(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, Visit&& visit) {
  UInt<F> kind(0u);
  const bool one_kind = (scene.light_kinds & (scene.light_kinds - 1)) == 0;
  if (!one_kind) kind = gather(&scene.light_words->kind, UInt<F>(light * LightWords::stride));
  const auto lanes_of = [&](std::uint32_t index) {
    return one_kind ? active : active && equal<F>(kind, UInt<F>(index));
  };
  LightKinds::for_each([&]<template <class> class Kind>(std::uint32_t index) {
    if ((scene.light_kinds >> index & 1u) == 0) return;
    const Mask<F> lanes = lanes_of(index);
    if (any(lanes)) visit(light_record<Kind, F>(scene, light), lanes);
  });
  if (!has_general_lights(scene)) return;
  const Mask<F> lanes = lanes_of(general_light_kind);
  if (any(lanes)) visit(GeneralLight<F>(*scene.general_lights, light, lanes), lanes);
}

/// Picks a light as a photon's start, with probability proportional to its flux; `u` is uniform in [0,1). A single
/// light costs nothing.
template <class F>
LightSampling<F> choose_light(const SceneView& scene, const F& u) {
  if (scene.one_light) return {UInt<F>(0u), F(1.0f), UInt<F>(scene.light_words->primitive)};
  return choose_by_flux(scene.light_words, scene.light_count, u);
}

/// Chooses a light for next-event estimation at p; its probability is 0 where none can shine.
template <class F>
LightSampling<F> choose_light(const SceneView& scene, const Vec3<F>& p, const Mask<F>& active, const F& u) {
  if (!scene.lights_by_position) return choose_light(scene, u);
  return each_lane<LightSampling<F>, F>(
      active, [&](std::size_t i) { return scene.general_lights->choose(lane_of(p, i), lane_of(u, i)); });
}

/// The probability of that choice.
template <class F>
F choice_probability(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const Vec3<F>& p) {
  if (scene.one_light) return F(1.0f);
  if (!scene.lights_by_position) return gather(&scene.light_words->probability, UInt<F>(light * LightWords::stride));
  return each_lane<F, F>(active, [&](std::size_t i) {
    return scene.general_lights->choice_probability(lane_of(p, i), lane_of(light, i));
  });
}

/// A sampled point of a light for every lane; its density excludes the choice of the light. `findable`: lanes where a
/// ray could find it, too.
template <class F>
LightSample<F> sample_light(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const Vec3<F>& p,
                            const Vec2<F>& u, Mask<F>& findable) {
  LightSample<F> s{};
  findable = as_mask<F>(false);
  for_each_light_kind<F>(scene, light, active, [&](const auto& kind, const Mask<F>& lanes) {
    s = select(lanes, kind.sample(p, u), s);
    findable = findable || (lanes && !is_delta<F>(kind));
  });
  return s;
}

/// The point of a light that was met. Only lights that need tables use a mesh's triangle.
template <class F>
LightPoint<F> light_point(const SceneView& scene, const SurfaceHit<F>& hit, const UInt<F>& light) {
  LightPoint<F> at{hit.p, hit.normal};
  if (!has_general_lights(scene)) return at;
  at.triangle = hit.primitive;
  if (scene.small) at.triangle -= gather(&scene.light_words->primitive, UInt<F>(light * LightWords::stride));
  return at;
}

/// Density per solid angle at `p_from` with which next-event estimation would sample the point of `light` that was met,
/// including the choice of the light.
template <class F>
F direct_light_pdf(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const Vec3<F>& p_from,
                   const SurfaceHit<F>& met) {
  F pdf(0.0f);
  const LightPoint<F> at = light_point<F>(scene, met, light);
  for_each_light_kind<F>(scene, light, active, [&](const auto& kind, const Mask<F>& lanes) {
    pdf = select(lanes, kind.pdf(p_from, at), pdf);
  });
  if (scene.one_light) return pdf;
  return pdf * choice_probability<F>(scene, light, active, p_from);
}

/// Radiance of the lights that rays met, in `direction`, from the hit points to the rays' origins.
template <class F>
Vec3<F> emitted_radiance(const SceneView& scene, const SurfaceHit<F>& hit, const UInt<F>& light, const Mask<F>& active,
                         const Vec3<F>& direction) {
  Vec3<F> radiance(F(0.0f));
  const LightPoint<F> at = light_point<F>(scene, hit, light);
  for_each_light_kind<F>(scene, light, active, [&](const auto& kind, const Mask<F>& lanes) {
    radiance = select(lanes, kind.leaving(at, direction), radiance);
  });
  return radiance;
}

template <class F>
struct EnvironmentLook {
  Vec3<F> radiance;
  F pdf;  ///< per solid angle at the point it is seen from, including the choice of the light
};

/// The environment in the directions of rays that left the scene from `origin`. There must be one.
template <class F>
EnvironmentLook<F> look_at_environment(const SceneView& scene, const Vec3<F>& origin, const Vec3<F>& direction,
                                       const Mask<F>& active) {
  return each_lane<EnvironmentLook<F>, F>(active, [&](std::size_t i) {
    const Vec3f d = lane_of(direction, i);
    return EnvironmentLook<float>{scene.general_lights->environment_radiance(d),
                                  scene.general_lights->environment_pdf(lane_of(origin, i), d)};
  });
}

}  // namespace photonproof::inline renderer_kernels
