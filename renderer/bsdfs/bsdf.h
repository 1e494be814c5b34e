// The closed set of BSDFs. Each lives in bsdf_<name>.h as a struct of floats (or packs) with eval, pdf and sample;
// this header lists them. Directions are unit, in the local frame (z = normal), and point away from the surface; wo is
// where the path came from, wi where it goes. The cosine is never inside `eval`. A kind may have Dirac lobes and smooth
// lobes: eval and pdf cover the smooth ones only. pdf includes the probability that `sample` chooses them. Estimators
// read three constants of each kind:
//   `has_smooth`: eval is not always 0, so light sampling can reach it.
//   `is_lambertian`: eval does not depend on the directions above the surface and is 0 behind it. Photons of any
//                    direction count alike.
//   `lets_light_through`: light may come out behind the surface.
#pragma once

#include "renderer/bsdfs/bsdf_conductor.h"
#include "renderer/bsdfs/bsdf_dielectric.h"
#include "renderer/bsdfs/bsdf_difftrans.h"
#include "renderer/bsdfs/bsdf_diffuse.h"
#include "renderer/bsdfs/bsdf_layered.h"
#include "renderer/bsdfs/bsdf_null.h"
#include "renderer/bsdfs/bsdf_phong.h"
#include "renderer/bsdfs/bsdf_plastic.h"
#include "renderer/bsdfs/bsdf_principled.h"
#include "renderer/bsdfs/bsdf_principledthin.h"
#include "renderer/bsdfs/bsdf_roughconductor.h"
#include "renderer/bsdfs/bsdf_roughdielectric.h"
#include "renderer/bsdfs/bsdf_roughplastic.h"
#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/bsdf_thindielectric.h"
#include "renderer/bsdfs/rough_part.h"
#include "renderer/lanes/kind_list.h"

namespace photonproof::inline renderer_bsdfs {

/// One row a BSDF.
using BsdfKinds = KindList<DiffuseBsdf, ConductorBsdf, DielectricBsdf, NullBsdf, RoughConductorBsdf, ThinDielectricBsdf,
                           RoughDielectricBsdf, PlasticBsdf, RoughPlasticBsdf, PhongBsdf, LayeredDiffuseBsdf,
                           LayeredConductorBsdf, LayeredRoughConductorBsdf, LayeredPhongBsdf, PrincipledBsdf,
                           PrincipledGlassBsdf, PrincipledThinBsdf, DiffuseTransmitterBsdf>;

/// A BSDF of the scene, as the host sees it.
using Bsdf = BsdfKinds::Variant;

/// False where the BSDF is a sum of Dirac deltas: nothing to evaluate, next-event estimation cannot reach it.
inline bool has_smooth(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.has_smooth; }, bsdf);
}
inline bool is_lambertian(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.is_lambertian; }, bsdf);
}
inline bool lets_light_through(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.lets_light_through; }, bsdf);
}
/// Whether photons may be gathered for a part of it by their directions (rough_part.h), textures or not.
inline bool can_be_rough(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return CanBeRough<std::remove_cvref_t<decltype(b)>, float>; }, bsdf);
}
/// True where no part of it is a mirror, a sharp highlight or lets light through.
inline bool is_all_rough(const Bsdf& bsdf, const RoughLimit& limit) {
  return std::visit(
      [&](const auto& b) {
        if constexpr (requires { b.is_all_rough(limit); })
          return b.is_all_rough(limit);
        else
          return b.is_lambertian;
      },
      bsdf);
}
/// Bit k: photons may be gathered by their directions on kind k.
inline constexpr std::uint32_t rough_kinds = [] {
  std::uint32_t kinds = 0;
  BsdfKinds::for_each([&]<template <class> class Kind>(std::uint32_t kind) {
    if constexpr (CanBeRough<Kind<float>, float>) kinds |= 1u << kind;
  });
  return kinds;
}();

}  // namespace photonproof::inline renderer_bsdfs
