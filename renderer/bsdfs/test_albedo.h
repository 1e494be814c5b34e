// Albedo of reflective materials in a white furnace, by quadrature of `eval` alone; test code only.
#pragma once

#include <numbers>

#include "renderer/bsdfs/test_bsdfs.h"
#include "renderer/bsdfs/test_shading.h"

namespace photonproof::test {

/// The integral of f cos over the directions above the surface, for an isotropic BSDF, first channel. It takes
/// midpoints in the azimuth and in the root of the cosine, in which rough models are smooth up to the horizon.
inline double albedo_by_quadrature(const Bsdf& bsdf, double cos_wo, int steps) {
  const Vec3f wo(static_cast<float>(std::sqrt(1 - cos_wo * cos_wo)), 0, static_cast<float>(cos_wo));
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double root = (i + 0.5) / steps, cosine = root * root, sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < steps; ++k) {  // by symmetry half the azimuths suffice
      const double phi = std::numbers::pi * (k + 0.5) / steps;
      const Vec3f wi(Vec3d(sine * std::cos(phi), sine * std::sin(phi), cosine));
      sum += double{eval(bsdf, wo, wi).x} * cosine * 2 * root;  // d cos = 2 root d root
    }
  }
  return sum * 2 * std::numbers::pi / (double(steps) * steps);
}

}  // namespace photonproof::test
