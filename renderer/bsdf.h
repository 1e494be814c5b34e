// The closed set of BSDFs. Each lives in bsdf_<name>.h as a struct of floats (or packs) with eval, pdf and sample; this
// header lists them. Directions are unit, in the local frame (z = normal), and point away from the surface; wo is where
// the history came from, wi where it goes. The cosine is never inside `eval`.
#pragma once

#include "renderer/bsdf_conductor.h"
#include "renderer/bsdf_dielectric.h"
#include "renderer/bsdf_diffuse.h"
#include "renderer/bsdf_sample.h"
#include "renderer/kind_list.h"

namespace photonproof {

/// One row a BSDF.
using BsdfKinds = KindList<DiffuseBsdf, ConductorBsdf, DielectricBsdf>;

/// A BSDF of the scene, as the host sees it.
using Bsdf = BsdfKinds::Variant;

/// True where the BSDF is a sum of Dirac deltas: nothing to evaluate, next-event estimation cannot reach it.
inline bool is_delta(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.is_delta; }, bsdf);
}

}  // namespace photonproof
