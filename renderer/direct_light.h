// Next-event estimation at one point: one light, one point of it, one shadow ray.
#pragma once

#include "renderer/ray_counts.h"
#include "renderer/sampler.h"
#include "renderer/scene.h"

namespace photonproof {

/// Power heuristic, exponent 2 (Veach 1997, section 9.2.4): the weight of a sample of density `pdf` against `other`.
inline float mis_weight(float pdf, float other) {
  const float a = pdf * pdf;
  const float b = other * other;
  return a > 0 ? a / (a + b) : 0;
}

/// Density per solid angle with which `estimate_direct` would have drawn the point of light `light` at `hit`.
inline float direct_light_pdf(const Scene& scene, std::uint32_t light, const Vec3f& p_from, const Hit& hit) {
  return scene.light_probability(light) * pdf(scene.lights[light], p_from, hit.p_world, hit.normal);
}

/// Radiance reflected towards wo from one sample of one light. With `weighted` the sample carries its MIS weight
/// against BSDF sampling; otherwise it stands alone. Counts the shadow ray, which is skipped where either cosine is 0.
inline Rgb estimate_direct(const Scene& scene, const Hit& hit, const Bsdf& bsdf, const Frame& frame,
                           const Vec3f& wo_local, bool weighted, Sampler& sampler, RayCounts& counts) {
  const Scene::LightChoice choice = scene.choose_light(sampler.next());
  const Light& light = scene.lights[choice.index];
  const LightSample s = sample(light, hit.p_world, sampler.next2());
  if (!(s.pdf > 0)) return Rgb(0.0f);
  const Vec3f wi_local = frame.to_local(s.wi_world);
  const Rgb f = eval(bsdf, wo_local, wi_local);
  if (max_component(f) <= 0) return Rgb(0.0f);

  const Tracer& tracer = scene.tracer();
  const Vec3f from = tracer.offset(hit.p_world, hit.normal, s.wi_world);
  const bool surface_light = !is_delta(light);
  const Vec3f to = surface_light ? tracer.offset(s.p_light, s.normal_light, -s.wi_world) : s.p_light;
  ++counts.shadow;
  if (tracer.occluded({from, to - from, 0, 1})) return Rgb(0.0f);

  const float light_pdf = s.pdf * choice.probability;
  const float weight = weighted && surface_light ? mis_weight(light_pdf, pdf(bsdf, wo_local, wi_local)) : 1;
  return f * s.radiance * (std::abs(wi_local.z) * weight / light_pdf);
}

/// Radiance of a light met by a ray, in the direction the ray came from; 0 where the surface does not emit.
inline Rgb emitted_towards(const Scene& scene, const Hit& hit, const Vec3f& ray_direction) {
  const std::uint32_t light = scene.surfaces[hit.surface].light;
  if (light == no_index) return Rgb(0.0f);
  return emitted_radiance(scene.lights[light], -dot(hit.normal, ray_direction));
}

}  // namespace photonproof
