// The scene's lights for a pack: which one, a point of it, the density with which that point would have been drawn.
#pragma once

#include <cstring>

#include "renderer/kernels/general_lights.h"
#include "renderer/lanes/lane.h"
#include "renderer/light_choice/light_choice.h"
#include "renderer/lights/light_kinds.h"
#include "renderer/scene/scene_view.h"

namespace photonproof {

/// The record of a chosen light. A single one is the same in every lane: nothing to gather.
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

/// Calls visit(light record of F, lanes of that kind) for the kinds that occur among the active lanes' lights, and
/// general(lanes) for those that need tables.
template <class F, class Visit, class General>
void for_each_light_kind(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, Visit&& visit,
                         General&& general) {
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
  if ((scene.light_kinds >> general_light_kind & 1u) == 0) return;
  const Mask<F> lanes = lanes_of(general_light_kind);
  if (any(lanes)) general(lanes);
}

/// Picks a light as a photon's start, with probability proportional to its flux; `u` is uniform in [0,1). A single
/// light costs nothing.
template <class F>
LightChoice<F> choose_light(const SceneView& scene, const F& u) {
  if (scene.one_light) return {UInt<F>(0u), F(1.0f), UInt<F>(scene.light_words->primitive)};
  return choose_by_flux(scene.light_words, scene.light_count, u);
}

/// Picks a light for next-event estimation at p; its probability is 0 where none could shine.
template <class F>
LightChoice<F> choose_light(const SceneView& scene, const Vec3<F>& p, const Mask<F>& active, const F& u) {
  if (!scene.lights_by_position) return choose_light(scene, u);
  auto block = ask<LightChoiceBlock, F>(UInt<F>(0u), active);
  put(block.p, p);
  store_from(u, block.u);
  choose_lights(*scene.general_lights, block);
  const UInt<F> light = take_words<F>(block.light);
  return {light, take<F>(block.probability),
          gather(&scene.light_words->primitive, UInt<F>(light * LightWords::stride))};
}

/// The probability of that choice.
template <class F>
F choice_probability(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const Vec3<F>& p) {
  if (scene.one_light) return F(1.0f);
  if (!scene.lights_by_position) return gather(&scene.light_words->probability, UInt<F>(light * LightWords::stride));
  auto block = ask<LightChoiceBlock, F>(light, active);
  put(block.p, p);
  choice_probabilities(*scene.general_lights, block);
  return take<F>(block.probability);
}

/// Of a mesh light that was met.
template <class F>
UInt<F> triangle_of(const SceneView& scene, const SurfaceHit<F>& hit, const UInt<F>& light) {
  if (!scene.small) return hit.primitive;
  return hit.primitive - gather(&scene.light_words->primitive, UInt<F>(light * LightWords::stride));
}

/// Density per solid angle at `p_from` with which next-event estimation would have drawn the point of `light` that was
/// met.
template <class F>
F direct_light_pdf(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const Vec3<F>& p_from,
                   const SurfaceHit<F>& met) {
  F pdf(0.0f);
  for_each_light_kind<F>(
      scene, light, active,
      [&](const auto& record, const Mask<F>& lanes) {
        pdf = select(lanes, record.pdf(p_from, met.p, met.normal), pdf);
      },
      [&](const Mask<F>& lanes) {
        auto block = ask<LightPdfBlock, F>(light, lanes);
        put(block.p, p_from);
        put(block.p_light, met.p);
        put(block.normal, met.normal);
        store_from(triangle_of<F>(scene, met, light), block.triangle);
        light_pdfs(*scene.general_lights, block);
        pdf = select(lanes, take<F>(block.pdf), pdf);
      });
  if (scene.one_light) return pdf;
  return pdf * choice_probability<F>(scene, light, active, p_from);
}

/// Radiance of the lights that rays met, in `direction`, from where they were met to where the rays came from.
template <class F>
Vec3<F> emitted_radiance(const SceneView& scene, const SurfaceHit<F>& hit, const UInt<F>& light, const Mask<F>& active,
                         const Vec3<F>& direction) {
  Vec3<F> radiance(F(0.0f));
  for_each_light_kind<F>(
      scene, light, active,
      [&](const auto& record, const Mask<F>& lanes) {
        radiance = select(lanes, record.leaving(hit.normal, direction), radiance);
      },
      [&](const Mask<F>& lanes) {
        auto block = ask<LightRadianceBlock, F>(light, lanes);
        put(block.p, hit.p);
        put(block.normal, hit.normal);
        put(block.direction, direction);
        store_from(triangle_of<F>(scene, hit, light), block.triangle);
        radiance_of_lights(*scene.general_lights, block);
        radiance = select(lanes, take3<F>(block.radiance), radiance);
      });
  return radiance;
}

template <class F>
struct EnvironmentLook {
  Vec3<F> radiance;
  F pdf;  ///< per solid angle at the place it is seen from, the choice inside
};

/// The environment in the directions of rays that left the scene from `origin`. There must be one.
template <class F>
EnvironmentLook<F> look_at_environment(const SceneView& scene, const Vec3<F>& origin, const Vec3<F>& direction,
                                       const Mask<F>& active) {
  const UInt<F> light(scene.environment);
  auto block = ask<EnvironmentBlock, F>(light, active);
  put(block.direction, direction);
  look_at_environment(*scene.general_lights, block);
  return {take3<F>(block.radiance), take<F>(block.pdf) * choice_probability<F>(scene, light, active, origin)};
}

}  // namespace photonproof
