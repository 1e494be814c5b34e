// Lights that need tables as one more kind of light_kinds.h: packs call scene_lights.h, one lane after the other.
#pragma once

#include "renderer/lanes/lane_records.h"
#include "renderer/light_sampling/scene_lights.h"

namespace photonproof::inline renderer_kernels {

/// Each lane's own light; the answer is zeros in lanes outside `lanes`.
template <class F>
class GeneralLight {
 public:
  GeneralLight(const SceneLights& lights, const UInt<F>& light, const Mask<F>& lanes)
      : lights_(lights), light_(light), lanes_(lanes) {}

  LightSample<F> sample(const Vec3<F>& p, const Vec2<F>& u) const {
    return ask<LightSample<F>>([&](std::uint32_t light, std::size_t i) {
      return LightSample<float>(lights_.sample_of(light, lane_of(p, i), lane_of(u, i)));
    });
  }
  F pdf(const Vec3<F>& p, const LightPoint<F>& at) const {
    return ask<F>(
        [&](std::uint32_t light, std::size_t i) { return lights_.pdf_of(light, lane_of(p, i), lane_of(at, i)); });
  }
  /// Guided where the scene's lights are, for every kind of light.
  Emission<F> emit(const Vec2<F>& u_position, const Vec2<F>& u_direction) const {
    return ask<Emission<F>>([&](std::uint32_t light, std::size_t i) {
      return Emission<float>(lights_.start_of(light, lane_of(u_position, i), lane_of(u_direction, i)));
    });
  }
  Vec3<F> flux_towards(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return ask<Vec3<F>>([&](std::uint32_t light, std::size_t i) {
      return lights_.flux_towards(light, lane_of(at, i), lane_of(direction, i));
    });
  }
  /// Radiance leaving points that rays met.
  Vec3<F> leaving(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return ask<Vec3<F>>([&](std::uint32_t light, std::size_t i) {
      return lights_.radiance(light, lights_.with_uv(light, lane_of(at, i)), lane_of(direction, i));
    });
  }
  Mask<F> is_delta() const {
    return ask_whether([&](std::uint32_t light) { return lights_.is_delta(light); });
  }
  Mask<F> is_infinite() const {
    return ask_whether([&](std::uint32_t light) { return lights_.is_infinite(light); });
  }

 private:
  template <class Answer, class Ask>
  Answer ask(const Ask& one) const {
    return each_lane<Answer, F>(lanes_, [&](std::size_t i) { return one(lane_of(light_, i), i); });
  }
  template <class Ask>
  Mask<F> ask_whether(const Ask& one) const {
    return !equal<F>(ask<UInt<F>>([&](std::uint32_t light, std::size_t) { return one(light) ? 1u : 0u; }), UInt<F>(0u));
  }

  const SceneLights& lights_;
  UInt<F> light_;
  Mask<F> lanes_;
};

template <class F, class Kind>
Mask<F> is_delta(const Kind&) {
  return as_mask<F>(Kind::is_delta);
}
template <class F>
Mask<F> is_delta(const GeneralLight<F>& light) {
  return light.is_delta();
}
template <class F, class Kind>
Mask<F> is_infinite(const Kind&) {
  return as_mask<F>(Kind::is_infinite);
}
template <class F>
Mask<F> is_infinite(const GeneralLight<F>& light) {
  return light.is_infinite();
}

}  // namespace photonproof::inline renderer_kernels
