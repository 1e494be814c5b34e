// The scene's lights for a pack: which one, a point of it, the density with which that point would have been drawn.
#pragma once

#include "renderer/lane.h"
#include "renderer/light.h"
#include "renderer/scene_view.h"

namespace photonproof {

/// Calls visit(light record of F, lanes of that kind) for the kinds that occur among the active lanes' lights.
template <class F, class Visit>
void for_each_light_kind(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, Visit&& visit) {
  UInt<F> kind(0u);
  const bool one_kind = (scene.light_kinds & (scene.light_kinds - 1)) == 0;
  if (!one_kind) kind = gather(&scene.light_words->kind, UInt<F>(light * LightWords::stride));
  LightKinds::for_each([&]<template <class> class Kind>(std::uint32_t index) {
    if ((scene.light_kinds >> index & 1u) == 0) return;
    const Mask<F> lanes = one_kind ? active : active && equal<F>(kind, UInt<F>(index));
    if (any(lanes)) visit(gather_record<Kind, F>(scene.lights, light, LightKinds::stride), lanes);
  });
}

template <class F>
struct LightChoice {
  UInt<F> light;
  F probability;
  UInt<F> primitive;
};

/// Picks a light with probability proportional to its flux; `u` is uniform in [0,1). A single light costs nothing.
template <class F>
LightChoice<F> choose_light(const SceneView& scene, const F& u) {
  const LightWords* first = scene.light_words;
  if (scene.one_light) return {UInt<F>(0u), F(1.0f), UInt<F>(first->primitive)};
  const auto count = static_cast<float>(scene.light_count);
  const F scaled = u * count;
  UInt<F> slot = to_uint(lane_min(scaled, F(count - 1)));
  const UInt<F> word = slot * LightWords::stride;
  const F within = scaled - to_float(slot);
  const Mask<F> keep = within < gather(&first->alias_threshold, word);
  slot = select(keep, slot, gather(&first->alias, word));
  const UInt<F> chosen = slot * LightWords::stride;
  return {slot, gather(&first->probability, chosen), gather(&first->primitive, chosen)};
}

/// Density per solid angle at `p_from` with which next-event estimation would have drawn the point p of `light`.
template <class F>
F direct_light_pdf(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const Vec3<F>& p_from,
                   const Vec3<F>& p, const Vec3<F>& normal) {
  F pdf(0.0f);
  for_each_light_kind<F>(scene, light, active, [&](const auto& record, const Mask<F>& lanes) {
    pdf = select(lanes, record.pdf(p_from, p, normal), pdf);
  });
  if (scene.one_light) return pdf;
  return pdf * gather(&scene.light_words->probability, light * LightWords::stride);
}

/// Radiance of the lights that rays met, towards where the rays came from.
template <class F>
Vec3<F> emitted_radiance(const SceneView& scene, const UInt<F>& light, const Mask<F>& active, const F& cos_emit) {
  Vec3<F> radiance(F(0.0f));
  for_each_light_kind<F>(scene, light, active, [&](const auto& record, const Mask<F>& lanes) {
    radiance = select(lanes, record.emitted_radiance(cos_emit), radiance);
  });
  return radiance;
}

}  // namespace photonproof
