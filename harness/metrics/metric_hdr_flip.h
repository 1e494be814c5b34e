// The exposures of HDR-FLIP; metric_hdr_flip.cpp has the metric.
#pragma once

#include <optional>

#include "harness/metrics/metrics.h"

namespace photonproof {

class RowSource;

/// The range the paper derives from the reference image: from where tone mapping takes its greatest luminance to 0.85
/// to where it takes its median luminance there, with max(2, ceil(stop - start)) exposures. Reads the image twice.
/// Empty when the median luminance is 0.
std::optional<ExposureRange> exposures_of(RowSource& reference);

}  // namespace photonproof
