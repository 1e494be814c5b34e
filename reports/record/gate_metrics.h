// Metrics that gates bound besides those of `compare`: deviations of many images from the reference in units of their
// noise.
#pragma once

#include <string_view>

namespace photonproof::inline reports_record {

inline constexpr const char* agreement_metric = "agreement";
inline constexpr const char* bias_metric = "bias";
inline constexpr const char* block_bias_metric = "block_bias";

/// The tiles of such a gate have a score in standard errors beyond noise; tiles of other gates have a share of the
/// error.
inline bool weighs_noise(std::string_view metric) {
  return metric == agreement_metric || metric == bias_metric || metric == block_bias_metric;
}

}  // namespace photonproof::inline reports_record
