// Whether a quantity that is measured repeatedly grows: memory, files, bytes on disk.
//
// A line is fitted through the values by least squares. A process mostly keeps what it held before, so residuals follow
// each other. With lag-one correlation r, n values are worth n (1 - r)/(1 + r) independent ones. The slope's standard
// error and Student's degrees of freedom use that number. (Santer et al. 2000, "Statistical significance of trends and
// trend differences in layer-average atmospheric temperature time series", section 4)
#pragma once

#include <span>
#include <string>

#include "reports/record/results.h"

namespace photonproof::inline harness_stress_soak {

/// flat: growth above the bound would be detected, and none was. grows: growth is certain, and may be above the bound.
/// unclear: neither holds.
enum class DriftVerdict { flat, grows, unclear };
std::string to_string(DriftVerdict verdict);

struct Drift {
  double slope = 0;       ///< For each step.
  Interval interval{};    ///< 99.8 % interval of the slope: each end is wrong once in a thousand runs.
  double mean_value = 0;  ///< Mean of the values.
  DriftVerdict verdict = DriftVerdict::unclear;
};

/// Fewer values show nothing.
inline constexpr std::size_t least_drift_values = 5;

/// `bound`: a growth a step that is too small to matter. One value a step, at equal distances.
Drift drift_of(std::span<const double> values, double bound);

}  // namespace photonproof::inline harness_stress_soak
