// Scattering at a surface point whose shading normal ns may differ from its geometric normal ng. Kernels (lanes) and
// scalar integrators both evaluate BSDFs here, so that none omits the correction of light paths.
//
// Camera paths define the surface. Seen along o and lit along i, it reflects K(o,i) = f(o,i) |i.ns|. K also contains
// the share of light that bump and normal maps let through. The normal ns is the one that these maps show to o. Flux is
// measured over true areas, |i.ng|. Both directions of transport must have the same inner products,
//   int int W(o) |o.ng| K(o,i) L(i) di do.
// A light path that arrives along i therefore leaves along o with K*(i,o) do = K(o,i) |o.ng| / |i.ng| do (Veach 1997,
// section 5.3.2). That is f times the cosine |i.ns| |o.ng| / |i.ng|. A photon gathered without its direction carries
// the factor |i.ns| / |i.ng| (`landing`).
//
// Directions are unit, in the frame of ns, and point away from the surface.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_bsdfs {

/// The share of light that is not shadowed by the bumps that tilt a normal: Smith's for GGX of roughness alpha.
/// `cosine` is that of the direction to the normal before the tilt. Source: Estevez, Lecocq and Stein 2019, "A
/// Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem", eqs. 2 and 3.
template <class F>
F bump_shadowing(const F& alpha2, const F& cosine) {
  const F c = lane_abs(cosine);
  return 2 * c / (c + lane_sqrt(F(c * c + alpha2 * lane_max(F(1 - c * c), F(0.0f)))));
}

/// The bump and normal maps that made a shading normal, at most two of them, one over the other.
template <class F>
struct MappedNormals {
  /// Bits of `state`. The normal that a map shows depends on the viewing direction, but light paths know only the
  /// incoming one. They choose a state and leave only in directions from which that state is seen.
  static constexpr std::uint32_t turned = 1u;                      ///< A twosided BSDF shows its back.
  static constexpr std::uint32_t flipped[2] = {1u << 1, 1u << 2};  ///< The map's normal is mirrored to face the viewer.
  static constexpr std::uint32_t flips[2] = {1u << 3, 1u << 4};    ///< The map mirrors its normal where needed.
  static constexpr std::uint32_t faces[2] = {1u << 5, 1u << 6};    ///< Its viewer is in front of the normal below it.
  /// Bits that a photon and a gather must share, moved up beside the number of their surface (photon_columns.h).
  static constexpr std::uint32_t tag_bits = 3;

  Vec3<F> below[2];  ///< normals under the first and the second map; ns where there is none.
  F shadow[2];       ///< Alpha^2 of bump_shadowing; 0 where the map has none.
  UInt<F> state;
  F chance;  ///< probability that a light path chooses this state

  /// The share of light along `to_light` that arrives: 0 where only the maps place the light on this side.
  F part_arriving(const Vec3<F>& to_light) const {
    F part(1.0f);
    for (int map = 0; map < 2; ++map) {
      const F under = dot(below[map], to_light), over = above(map, to_light);
      part = select(under * over > 0, F(part * bump_shadowing(shadow[map], under)), F(0.0f));
    }
    return part;
  }

  /// Whether this state is the one seen along `to_camera`.
  Mask<F> seen_from(const Vec3<F>& to_camera) const {
    Mask<F> seen = as_mask<F>(true);
    for (int map = 0; map < 2; ++map) {
      const F under = dot(below[map], to_camera), over = above(map, to_camera);
      const F tilt = map == 0 ? dot(below[0], below[1]) : below[1].z;
      const Mask<F> mirrored = has(flipped[map]);
      const F original = select(mirrored, F(2 * tilt * under - over), over);
      const Mask<F> invalid = !(under * original > 0);
      seen = seen && (!has(flips[map]) || (mirrored && invalid) || (!mirrored && !invalid)) &&
             (!has(faces[map]) || under > 0);
    }
    return seen;
  }

 private:
  F above(int map, const Vec3<F>& direction) const { return map == 0 ? dot(below[1], direction) : direction.z; }
  Mask<F> has(std::uint32_t bit) const { return !equal<F>(UInt<F>(state & bit), UInt<F>(0u)); }
};

template <class F>
struct Scattering {
  Frame<F> frame{Vec3<F>(F(0.0f), F(0.0f), F(1.0f))};  ///< Frame of the shading normal.
  bool bent = false;    ///< Some shading normals differ from geometric ones; if false, the rest is not read.
  bool mapped = false;  ///< Maps make some of these normals; if false, `maps` is not read.
  Vec3<F> ng{};         ///< Geometric normal, in the frame.
  MappedNormals<F> maps{};

  /// Value f for light that arrives along `to_light` and leaves along `to_camera`; no cosine, smooth part alone.
  template <class B>
  Vec3<F> eval(const B& bsdf, const Vec3<F>& to_camera, const Vec3<F>& to_light) const {
    const Vec3<F> f = bsdf.eval(to_camera, to_light);
    return mapped ? Vec3<F>(f * maps.part_arriving(to_light)) : f;
  }

  /// The cosine that multiplies f in a path of that mode: the light direction's for camera paths, the adjoint's for
  /// light paths.
  F cosine(const Vec3<F>& to_camera, const Vec3<F>& to_light, TransportMode mode) const {
    const F to_ns = lane_abs(to_light.z);
    if (mode == TransportMode::radiance || !bent)
      return mode == TransportMode::radiance ? to_ns : lane_abs(to_camera.z);
    const F to_ng = lane_abs(dot(ng, to_light));
    return select(to_ng > 0, F(to_ns * lane_abs(dot(ng, to_camera)) / to_ng), F(0.0f));
  }

  /// Factor of flux that lands along `to_light`, for gathers that take a Lambertian surface's flux over true area for
  /// irradiance.
  F landing(const Vec3<F>& to_light) const {
    const F to_ng = lane_abs(dot(ng, to_light));
    const F worth = select(to_ng > 0, F(lane_abs(to_light.z) / to_ng), F(0.0f));
    return mapped ? F(worth * maps.part_arriving(to_light) / maps.chance) : worth;
  }

  /// Density per solid angle with which `sample` gives wi when the path came from wo; smooth part alone.
  template <class B>
  F pdf(const B& bsdf, const Vec3<F>& wo, const Vec3<F>& wi, TransportMode mode) const {
    if (mode == TransportMode::radiance || !bent) return bsdf.pdf(wo, wi);
    F density;
    if constexpr (B::is_lambertian)
      density = select(wo.z > 0 && wi.z > 0, F(lane_abs(dot(ng, wi)) * (1 / pi)), F(0.0f));
    else
      density = bsdf.pdf(wo, wi);
    return mapped ? F(density * maps.chance) : density;
  }

  /// The weight is f times `cosine` over the density.
  template <class B>
  BsdfSample<F> sample(const B& bsdf, const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode mode) const {
    if (mode == TransportMode::radiance) {
      BsdfSample<F> drawn = bsdf.sample(wo, u_lobe, u, mode);
      if (mapped) scale(drawn, maps.part_arriving(drawn.wi_local));
      return drawn;
    }
    if (!bent) return bsdf.sample(wo, u_lobe, u, mode);
    BsdfSample<F> drawn = along_light(bsdf, wo, u_lobe, u);
    if (mapped) {
      drawn.valid = drawn.valid && maps.seen_from(drawn.wi_local);
      drawn.pdf *= maps.chance;
    }
    return drawn;
  }

 private:
  static void scale(BsdfSample<F>& drawn, const F& part) {
    drawn.weight *= part;
    drawn.valid = drawn.valid && part > 0;
  }

  template <class B>
  BsdfSample<F> along_light(const B& bsdf, const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u) const {
    if constexpr (B::is_lambertian) {
      // The density |wi.ng| / pi over the hemisphere of ns integrates to 1, whatever the angle between the normals.
      // Samples of the cosine distribution about ng that fall behind ns are reversed. The weight does not depend on wi.
      Vec3<F> wi = Frame<F>(ng).to_world(square_to_cosine_hemisphere(u));
      wi = select(wi.z < 0, Vec3<F>(-wi), wi);
      const Vec3<F> weight = bsdf.eval(wo, Vec3<F>(F(0.0f), F(0.0f), F(1.0f))) * pi;
      BsdfSample<F> drawn{
          wi, weight, F(lane_abs(dot(ng, wi)) * (1 / pi)), F(1.0f), as_mask<F>(false), wo.z > 0 && wi.z > 0};
      scale(drawn, landing(wo));
      return drawn;
    } else {
      BsdfSample<F> drawn = bsdf.sample(wo, u_lobe, u, TransportMode::importance);
      const F to_ns = lane_abs(drawn.wi_local.z);
      const F leaving = select(to_ns > 0, F(lane_abs(dot(ng, drawn.wi_local)) / to_ns), F(0.0f));
      scale(drawn, F(leaving * landing(wo)));
      return drawn;
    }
  }
};

/// One BSDF with its shading point, for code that works on any BSDF.
template <class B, class F>
struct ScatteringBsdf {
  B bsdf;
  Scattering<F> at;

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const { return at.eval(bsdf, wo, wi); }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const { return at.pdf(bsdf, wo, wi, TransportMode::radiance); }
};

}  // namespace photonproof::inline renderer_bsdfs
