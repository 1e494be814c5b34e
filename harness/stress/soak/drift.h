// Whether a quantity that is measured again and again grows: memory, files, bytes on disk.
//
// A line is fitted through the values by least squares. What a process holds now it mostly held before, so residuals
// follow each other: with lag-one correlation r, n values are worth n (1 - r)/(1 + r) independent ones (Santer et al.
// 2000, "Statistical significance of trends and trend differences in layer-average atmospheric temperature time
// series", section 4), by which the slope's standard error and Student's degrees of freedom go.
#pragma once

#include <span>
#include <string>

#include "reports/record/results.h"

namespace photonproof::inline harness_stress_soak {

/// flat: growth above the bound would have been seen, and none was; grows: it is certain, and may be above the bound;
/// unclear: neither can be said.
enum class DriftVerdict { flat, grows, unclear };
std::string to_string(DriftVerdict verdict);

struct Drift {
  double slope = 0;       ///< a step
  Interval interval{};    ///< of the slope, 99.8 %: each end is wrong once in a thousand runs
  double mean_value = 0;  ///< of the values
  DriftVerdict verdict = DriftVerdict::unclear;
};

/// Fewer say nothing.
inline constexpr std::size_t least_drift_values = 5;

/// `bound`: a growth a step that is too small to matter. Values are one a step, of equal distance.
Drift drift_of(std::span<const double> values, double bound);

}  // namespace photonproof::inline harness_stress_soak
