// Real spherical harmonics of a direction, orthonormal over the sphere and with the phase of Condon and Shortley.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "scenes/base/vec.h"
#include "scenes/ellipsoids/ellipsoid_cloud.h"

namespace photonproof::inline renderer_integrators {

class Harmonics {
 public:
  /// For `coefficients` functions, the square of the highest degree + 1.
  explicit Harmonics(std::size_t coefficients);

  static constexpr std::size_t most = (kMostHarmonicDegree + 1) * (kMostHarmonicDegree + 1);
  using Values = std::array<float, most>;
  /// Their values in a unit direction, degree after degree with ascending order. Source: recurrences of Sloan 2013,
  /// "Efficient Spherical Harmonic Evaluation".
  void evaluate(const Vec3f& direction, Values& values) const;

 private:
  std::size_t degree_;
  std::array<float, most> scale_{};  ///< of each function, to be orthonormal
};

}  // namespace photonproof::inline renderer_integrators
