#include "renderer/integrators/harmonics.h"

#include <cmath>
#include <numbers>

namespace photonproof::inline renderer_integrators {

Harmonics::Harmonics(std::size_t coefficients) : degree_(0) {
  while ((degree_ + 2) * (degree_ + 2) <= coefficients) ++degree_;
  for (std::size_t l = 0; l <= degree_; ++l) {
    double ratio = 1;  // (l - m)! / (l + m)!
    for (std::size_t m = 0; m <= l; ++m) {
      if (m > 0) ratio /= static_cast<double>((l - m + 1) * (l + m));
      const double norm = std::sqrt((2 * static_cast<double>(l) + 1) / (4 * std::numbers::pi) * ratio);
      const auto scale = static_cast<float>(norm * (m > 0 ? std::numbers::sqrt2 : 1));
      scale_[l * l + l + m] = scale_[l * l + l - m] = scale;
    }
  }
}

// The associated Legendre functions without their powers of the sine, which are in the parts around the axis.
void Harmonics::evaluate(const Vec3f& direction, Values& values) const {
  float cosine = 1, sine = 0;  // of m times the azimuth, times the m-th power of the sine to the axis
  float first = 1;             // the function of degree and order m
  for (std::size_t m = 0; m <= degree_; ++m) {
    float before = 0, legendre = first;
    for (std::size_t l = m; l <= degree_; ++l) {
      values[l * l + l + m] = scale_[l * l + l + m] * legendre * cosine;
      if (m > 0) values[l * l + l - m] = scale_[l * l + l - m] * legendre * sine;
      const auto next = static_cast<float>(l + 1), order = static_cast<float>(m);
      const float above = ((2 * next - 1) * direction.z * legendre - (next + order - 1) * before) / (next - order);
      before = legendre;
      legendre = above;
    }
    first *= -(2 * static_cast<float>(m) + 1);
    const float turned = direction.x * cosine - direction.y * sine;
    sine = direction.x * sine + direction.y * cosine;
    cosine = turned;
  }
}

}  // namespace photonproof::inline renderer_integrators
