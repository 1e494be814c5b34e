// Image metrics as METRICS in README defines them: linear Rec.709 images, `reference` first, N = pixels x channels.
// A metric is one file (metric_*.cpp) and one row of the table in metrics.cpp.
#pragma once

#include <string>
#include <vector>

#include "harness/results.h"
#include "scenes/image.h"

namespace photonproof {

struct MetricOptions {
  /// Stops applied before the display encoding of psnr, ssim and flip (scale by 2^exposure, clamp to [0,1], sRGB).
  double exposure = 0;
};

/// A failure that no metric may hide: sizes differ or a value is not finite. The sentence says where.
struct ImageDefect {
  enum class Kind { size_mismatch, non_finite } kind;
  std::string sentence;
};
/// Empty when the pair can be compared.
std::vector<ImageDefect> find_defects(const Image& reference, const Image& test);

/// Every metric of the table that has a finite value, in its order. Left out are psnr of images that are equal once
/// encoded (infinite), ssim where a side is under 11 pixels, and bias where the reference's mean is 0.
/// Precondition: find_defects is empty.
std::vector<MetricValue> compute_metrics(const Image& reference, const Image& test, const MetricOptions& options);

/// The same on a context (metric_context.h) that other work on the pair, such as heat maps, can share.
class MetricContext;
std::vector<MetricValue> compute_metrics(const MetricContext& context);

/// Per-pixel maps behind the heat maps: LDR-FLIP in [0,1], and relative squared error (x-r)^2/(r^2+0.01) averaged over
/// channels. Row-major, one float a pixel. Precondition: find_defects is empty.
std::vector<float> flip_map(const Image& reference, const Image& test, const MetricOptions& options);
std::vector<float> relmse_map(const Image& reference, const Image& test);

}  // namespace photonproof
