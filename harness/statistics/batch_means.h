// The mean of independent batches, and the variance of that mean from how much they differ.
//
// Batches are renders of equal size and samples whose seeds differ. Within one, Sobol points make the samples of a
// pixel depend on each other, and bidirectional splats those of different pixels; between batches nothing does, so that
// var(mean) = sum_b (x_b - mean)^2 / (B (B - 1)) has no bias whatever the sampler. Sums are Welford's (1962), in double
// and in the order of the batches: going on from a file gives the bits of never having stopped.
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

  /// Throws InputError, naming `where`, when the batch has another size, a value that is not finite, or radiances whose
  /// variance floats do not hold. `squared_bias`: what its estimator says of itself, relative, of the pixels.
  void add(const Image& batch, const std::string& where, double squared_bias = 0);

  int width() const { return width_; }
  int height() const { return height_; }
  int samples_per_batch() const { return samples_per_batch_; }
  int batches() const { return batches_; }
  /// Root of the mean square of what the batches say, which more batches do not lessen; 0 of an unbiased estimator.
  double relative_bias() const;
  /// Mean and variance of the mean. Precondition: two batches at least.
  Rendering rendering() const;

  /// A small binary file that ends in a checksum, for this machine's byte order; replaced as a whole.
  void save(const std::filesystem::path& file) const;
  /// Throws InputError when it is no such file or is damaged.
  static BatchMeans load(const std::filesystem::path& file);

 private:
  int width_, height_, samples_per_batch_, batches_ = 0;
  double squared_biases_ = 0;           ///< of the batches, summed
  std::vector<double> mean_, squares_;  ///< sum of squared distances from the mean
};

}  // namespace photonproof::inline harness_statistics
