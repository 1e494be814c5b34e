#include "harness/statistics/relative_error.h"

namespace photonproof::inline harness_statistics {

double relative_mse(const Image& reference, const Image& test) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    const double difference = static_cast<double>(test.rgb[i]) - static_cast<double>(reference.rgb[i]);
    sum += difference * difference * relative_weight(reference.rgb[i]);
  }
  return sum / static_cast<double>(reference.rgb.size());
}

}  // namespace photonproof::inline harness_statistics
