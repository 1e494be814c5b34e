// The relative squared error behind relmse, for uses beyond the metric's single number.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

/// The epsilon of relmse: errors are squared and divided by reference^2 + 0.01.
inline constexpr double relmse_epsilon = 0.01;

/// 1 / (reference^2 + epsilon) of one channel value.
inline double relative_weight(float reference) {
  return 1 / (static_cast<double>(reference) * static_cast<double>(reference) + relmse_epsilon);
}

/// The metric relmse. Precondition: images of one size, finite.
double relative_mse(const Image& reference, const Image& test);

}  // namespace photonproof::inline harness_statistics
