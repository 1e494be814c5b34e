// Every kind of light on the host. The kinds of light_kinds.h can also be sampled by kernels in their lanes; kinds that
// need tables are classes with the same functions. The functions below call one light of any kind. scene_lights.h
// handles all lights of a scene.
#pragma once

#include <optional>
#include <type_traits>

#include "renderer/lights/light_area.h"
#include "renderer/lights/light_beam.h"
#include "renderer/lights/light_environment.h"
#include "renderer/lights/light_ies.h"
#include "renderer/lights/light_kinds.h"
#include "renderer/lights/light_projector.h"
#include "renderer/lights/light_smooth_mesh.h"
#include "renderer/lights/light_textured_spot.h"

namespace photonproof::inline renderer_lights {

/// A light's index is its kind in the kernels' tables.
using Light = LightKinds::VariantWith<AreaLight, EnvironmentLight, IesLight, TexturedSpotLight, ProjectorLight,
                                      SmoothMeshLight, BeamLight>;

/// Value of LightWords::kind for this light.
inline std::uint32_t kernel_kind(const Light& light) {
  return std::min(static_cast<std::uint32_t>(light.index()), general_light_kind);
}
/// A delta light cannot be found by a ray.
inline bool is_delta(const Light& light) {
  return std::visit([](const auto& l) { return l.is_delta; }, light);
}
inline bool is_infinite(const Light& light) {
  return std::visit([](const auto& l) { return l.is_infinite; }, light);
}
/// Whether it shines from beyond the scene.
inline bool is_outside(const Light& light) { return is_infinite(light) && !std::holds_alternative<BeamLight>(light); }
inline Rgb flux(const Light& light) {
  return std::visit([](const auto& l) { return l.flux(); }, light);
}
/// Empty for lights that illuminate nothing or come from infinity.
inline std::optional<LightBounds> light_bounds(const Light& light) {
  const Rgb f = flux(light);
  const float power = (f.x + f.y + f.z) / 3;
  if (is_infinite(light) || !(power > 0)) return std::nullopt;
  LightBounds bounds = std::visit(
      [](const auto& l) -> LightBounds {
        if constexpr (std::decay_t<decltype(l)>::is_infinite)
          return {};
        else
          return l.bounds();
      },
      light);
  bounds.power = power;
  return bounds;
}
inline LightSample<float> sample(const Light& light, const Vec3f& p, const Vec2<float>& u) {
  return std::visit([&](const auto& l) { return l.sample(p, u); }, light);
}
inline float pdf(const Light& light, const Vec3f& p, const LightPoint<float>& at) {
  return std::visit([&](const auto& l) { return l.pdf(p, at); }, light);
}
inline Emission<float> emit(const Light& light, const Vec2<float>& u_position, const Vec2<float>& u_direction) {
  return std::visit([&](const auto& l) { return l.emit(u_position, u_direction); }, light);
}
inline EmissionPdfs<float> emit_pdfs(const Light& light, const LightPoint<float>& at, const Vec3f& direction) {
  return std::visit([&](const auto& l) { return l.emit_pdfs(at, direction); }, light);
}
inline Rgb flux_towards(const Light& light, const LightPoint<float>& at, const Vec3f& direction) {
  return std::visit([&](const auto& l) { return l.flux_towards(at, direction); }, light);
}
inline Rgb leaving(const Light& light, const LightPoint<float>& at, const Vec3f& direction) {
  return std::visit([&](const auto& l) { return l.leaving(at, direction); }, light);
}
/// The point with its texture coordinates; lights whose radiance depends on them provide uv_at.
inline LightPoint<float> with_uv(const Light& light, LightPoint<float> at) {
  std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.uv_at(at); }) at.uv = l.uv_at(at);
      },
      light);
  return at;
}

}  // namespace photonproof::inline renderer_lights
