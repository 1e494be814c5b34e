// A BSDF whose kind is not known to the code that calls it.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_kernels {

/// Valid as long as the BSDF it refers to.
template <class F>
struct AnyBsdf {
  const void* bsdf;
  Vec3<F> (*eval_of)(const void*, const Vec3<F>& wo, const Vec3<F>& wi);
  F (*pdf_of)(const void*, const Vec3<F>& wo, const Vec3<F>& wi);

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const { return eval_of(bsdf, wo, wi); }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const { return pdf_of(bsdf, wo, wi); }
};

template <class F, class Record>
AnyBsdf<F> any_bsdf(const Record& bsdf) {
  return {
      &bsdf,
      [](const void* b, const Vec3<F>& wo, const Vec3<F>& wi) { return static_cast<const Record*>(b)->eval(wo, wi); },
      [](const void* b, const Vec3<F>& wo, const Vec3<F>& wi) { return static_cast<const Record*>(b)->pdf(wo, wi); }};
}

}  // namespace photonproof::inline renderer_kernels
