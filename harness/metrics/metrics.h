// Image metrics as docs/metrics.md defines them: linear Rec.709 images, `reference` first, N = pixels x
// channels. A metric is one file (metric_*.cpp) and one row of the table in metrics.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/metrics/metric_parameters.h"
#include "harness/pixels/pixel_mask.h"
#include "harness/pixels/pixel_region.h"
#include "reports/record/results.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_metrics {

struct MetricOptions {
  ParameterValues parameters{};
  int threads = 0;  ///< 0: all cores. The numbers do not depend on it.
  /// Only these pixels count: in pixelwise metrics their values, in windowed ones (ssim, flip, hdr_flip) the maps of
  /// whole images. It has the images' size, or the region's. Null: all count.
  std::shared_ptr<const PixelMask> mask{};
  /// Crops both images to this first.
  std::optional<PixelRegion> region{};
  std::vector<std::string> only{};  ///< Names in the table; empty: all that are not on request.
  std::vector<std::string> also{};  ///< Names that are computed in addition.
  std::string mask_name{};          ///< For the printed parameters.
};

/// A failure that no metric may hide: sizes differ or a value is not finite. The sentence names the place.
struct ImageDefect {
  enum class Kind { size_mismatch, non_finite } kind;
  std::string sentence;
};
/// Empty when the pair can be compared.
std::vector<ImageDefect> find_defects(const Image& reference, const Image& test);

/// Every requested metric of the table with a finite value, in the table's order. Left out are psnr of images that are
/// equal once encoded (infinite) and metrics that the table calls undefined. Precondition: find_defects is empty.
std::vector<MetricValue> compute_metrics(const Image& reference, const Image& test, const MetricOptions& options);

}  // namespace photonproof::inline harness_metrics
