// Image metrics as README's section of that name defines them: linear Rec.709 images, `reference` first, N = pixels x
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
  /// Only these pixels count: of the pixelwise metrics their values, of the windowed ones (ssim, flip, hdr_flip) the
  /// maps made from whole images. Of the images' size, or of the region's. Null: all count.
  std::shared_ptr<const PixelMask> mask{};
  /// As if both images had been cropped to this before.
  std::optional<PixelRegion> region{};
  std::vector<std::string> only{};  ///< names of the table; empty: all that are not on request
  std::vector<std::string> also{};  ///< names that are computed in any case
  std::string mask_name{};          ///< for the parameters that are printed
};

/// A failure that no metric may hide: sizes differ or a value is not finite. The sentence says where.
struct ImageDefect {
  enum class Kind { size_mismatch, non_finite } kind;
  std::string sentence;
};
/// Empty when the pair can be compared.
std::vector<ImageDefect> find_defects(const Image& reference, const Image& test);

/// Every metric of the table that was asked for and has a finite value, in its order. Left out are psnr of images that
/// are equal once encoded (infinite) and what the table says to be undefined. Precondition: find_defects is empty.
std::vector<MetricValue> compute_metrics(const Image& reference, const Image& test, const MetricOptions& options);

}  // namespace photonproof::inline harness_metrics
