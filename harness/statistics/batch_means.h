// The mean of independent batches, and the variance of that mean, estimated from the differences between batches.
//
// Batches are renders of equal size and sample count with different seeds. Within a batch, Sobol points correlate the
// samples of a pixel, and bidirectional splats correlate pixels. Batches are independent of each other, so var(mean) =
// sum_b (x_b - mean)^2 / (B (B - 1)) is unbiased for every sampler. Sums are Welford's (1962), in double and in the
// order of the batches. A run resumed from a file thus gives the same bits as one that never stopped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

class BatchMeans {
 public:
  BatchMeans(int width, int height, int samples_per_batch);

  /// Throws InputError, naming `where`, when the batch has another size, values that are not finite, or radiances whose
  /// variance is outside the range of floats. `squared_bias`: the relative bias that the estimator states, squared.
  void add(const Image& batch, const std::string& where, double squared_bias = 0);

  int width() const { return width_; }
  int height() const { return height_; }
  int samples_per_batch() const { return samples_per_batch_; }
  int batches() const { return batches_; }
  /// Root of the mean square of the batches' stated biases, which more batches do not reduce; 0 for an unbiased
  /// estimator.
  double relative_bias() const;
  /// Mean and variance of the mean. Precondition: two batches at least.
  Rendering rendering() const;

  /// A small binary file that ends in a checksum, for this machine's byte order; replaced as a whole.
  void save(const std::filesystem::path& file) const;
  /// Throws InputError when the file is not of this format or is damaged.
  static BatchMeans load(const std::filesystem::path& file);

 private:
  int width_, height_, samples_per_batch_, batches_ = 0;
  double squared_biases_ = 0;           ///< sum of the batches' squared biases
  std::vector<double> mean_, squares_;  ///< sum of squared distances from the mean
};

}  // namespace photonproof::inline harness_statistics
