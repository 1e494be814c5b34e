// The exposures of HDR-FLIP; metric_hdr_flip.cpp has the metric.
#pragma once

#include <optional>

#include "harness/metrics/metrics.h"

namespace photonproof::inline harness_pixels {
class RowSource;
}

namespace photonproof::inline harness_metrics {

/// The range that the paper derives from the reference image, with max(2, ceil(stop - start)) exposures. At the start,
/// tone mapping maps the greatest luminance to 0.85, at the stop the median. Reads the image twice. A median below
/// 2^-23 counts as 2^-23, as in NVIDIA's tool 1.7. Empty when the image is black.
std::optional<ExposureRange> exposures_of(RowSource& reference);

}  // namespace photonproof::inline harness_metrics
