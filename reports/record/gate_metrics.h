// What gates bound besides the metrics of `compare`: deviations of many images from the reference, weighed against
// their noise.
#pragma once

#include <string_view>

namespace photonproof::inline reports_record {

inline constexpr const char* agreement_metric = "agreement";
inline constexpr const char* bias_metric = "bias";
inline constexpr const char* block_bias_metric = "block_bias";

/// Such a gate's tiles are so many standard errors beyond noise; those of the others have a share of the error.
inline bool weighs_noise(std::string_view metric) {
  return metric == agreement_metric || metric == bias_metric || metric == block_bias_metric;
}

}  // namespace photonproof::inline reports_record
