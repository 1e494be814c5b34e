#include "harness/statistics/deviations.h"

#include <algorithm>
#include <cmath>

#include "harness/statistics/brightest_sample.h"
#include "harness/statistics/shared_noise.h"
#include "harness/statistics/student.h"
#include "scenes/base/faults.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One channel of all images, in double.
struct Channel {
  std::size_t width = 0;
  double images = 0;
  std::vector<double> mean, variance;  ///< a pixel of one image
  std::vector<double> squares, cubes;  ///< second and third central moment of one image, as the images differ
  std::vector<double> least;           ///< variance of one image, known besides
  std::vector<double> reference, reference_variance;
};

Channel channel_of(const Rendering& reference, std::span<const Image* const> images, std::size_t c,
                   const Image* least_variance) {
  Channel channel{
      static_cast<std::size_t>(reference.mean.width), static_cast<double>(images.size()), {}, {}, {}, {}, {}, {}, {}};
  for (std::size_t i = c; i < reference.mean.rgb.size(); i += 3) {
    double mean = 0, squares = 0, cubes = 0;
    for (const Image* image : images) mean += double{image->rgb[has_fault(Fault::red_for_all) ? i - c : i]};
    mean /= channel.images;
    for (const Image* image : images) {
      const double off = double{image->rgb[i]} - mean;
      squares += off * off;
      cubes += off * off * off;
    }
    channel.squares.push_back(squares / (channel.images - 1));
    channel.least.push_back(least_variance ? double{least_variance->rgb[i]} : 0);
    channel.mean.push_back(mean);
    channel.variance.push_back(std::max(channel.squares.back(), channel.least.back()));
    const double n = channel.images;
    channel.cubes.push_back(n > 2 ? cubes * n / ((n - 1) * (n - 2)) : 0);
    const double expected = double{reference.mean.rgb[i]};
    channel.reference.push_back(expected);
    channel.reference_variance.push_back(
        std::max(double{reference.variance->rgb[i]}, std::pow(std::ldexp(expected, -11), 2)));
  }
  return channel;
}

/// The degrees of freedom of a sum of variances, each estimated with `freedom`, from the sum and the sum of their
/// squares: E[s^4] = sigma^4 (1 + 2/f).
double freedom_of_sum(double freedom, double sum, double squares) {
  return squares > 0 ? (freedom + 2) * sum * sum / squares : infinity;
}

/// An estimate and its expectation, each worth its degrees of freedom.
KnownVariance steadied(const KnownVariance& estimate, const KnownVariance& expectation) {
  if (std::isinf(expectation.freedom)) return expectation;
  if (expectation.freedom <= 0) return estimate;
  const double freedom = estimate.freedom + expectation.freedom;
  return {(estimate.freedom * estimate.variance + expectation.freedom * expectation.variance) / freedom, freedom};
}

struct BlockSums {
  double pixels = 0, noisy_pixels = 0, variance = 0, variance_squared = 0, variance_cubed = 0, skewed = 0,
         reference = 0, reference_variance = 0, reference_variance_squared = 0, mean = 0, squares = 0, cubes = 0,
         least = 0;
  /// The amount that one sample adds to a pixel of one image.
  double sample() const { return squares > 0 ? std::max(0.0, cubes / squares) : 0; }
  double brightness() const { return std::abs(reference) / pixels; }
};

class ChannelDeviations {
 public:
  ChannelDeviations(const Channel& channel, std::span<const Image* const> images, std::size_t c,
                    const KnownNoise& known, Deviations& out)
      : channel_(channel),
        images_(images),
        c_(c),
        known_(known),
        out_(out),
        freedom_(channel.images - 1),
        shared_(shared_noise(images, c)) {
    // Pixels of one image may share light but do not avoid each other's: a ratio below 1 is chance.
    shared_.within_blocks = std::max(1.0, shared_.within_blocks);
  }

  /// Call before `measure`: the samples of this channel count for all three.
  void add_to(BrightestSample& brightest) {
    for (const Block& block : out_.places) sums_.push_back(sums_over(block));
    brightness_ = sums_over({0, 0, out_.width, out_.height}).brightness();
    for (const BlockSums& block : sums_) brightest.add(block.sample(), block.brightness(), brightness_);
  }

  void measure(const BrightestSample& brightest) {
    brightest_ = brightest;
    const double blocks = static_cast<double>(out_.places.size());
    out_.independent_blocks[c_] =
        shared_.blocks > 0 ? blocks * shared_.surely_independent() / static_cast<double>(shared_.blocks) : blocks;
    measure_pixels();
    measure_blocks();
    measure_whole();
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * channel_.width + static_cast<std::size_t>(x);
  }

  BlockSums sums_over(const Block& block) const {
    BlockSums sums;
    for_each_pixel(block, [&](int x, int y) {
      const std::size_t i = index(x, y);
      sums.pixels += 1;
      sums.mean += channel_.mean[i];
      if (channel_.variance[i] > 0) sums.noisy_pixels += 1;
      sums.variance += channel_.variance[i];
      sums.squares += channel_.squares[i];
      sums.cubes += channel_.cubes[i];
      sums.least += channel_.least[i];
      sums.variance_cubed += std::pow(channel_.variance[i], 3);
      sums.skewed += channel_.cubes[i] * std::pow(channel_.variance[i], 1.5);
      sums.variance_squared += channel_.variance[i] * channel_.variance[i];
      sums.reference += channel_.reference[i];
      sums.reference_variance += channel_.reference_variance[i];
      sums.reference_variance_squared += std::pow(channel_.reference_variance[i], 2);
    });
    return sums;
  }

  /// Largest difference of reference values within 3 x 3 pixels.
  double contrast_around(int x, int y) const {
    double least = channel_.reference[index(x, y)], most = least;
    for (int near_y = std::max(0, y - 1); near_y <= std::min(out_.height - 1, y + 1); ++near_y)
      for (int near_x = std::max(0, x - 1); near_x <= std::min(out_.width - 1, x + 1); ++near_x) {
        least = std::min(least, channel_.reference[index(near_x, near_y)]);
        most = std::max(most, channel_.reference[index(near_x, near_y)]);
      }
    return most - least;
  }

  void measure_pixels() {
    auto& pixels = out_.pixels[c_];
    pixels.resize(channel_.mean.size());
    for (std::size_t b = 0; b < sums_.size(); ++b) {
      // The light's pixels must not make the other pixels of the block look certain.
      const double mean = sums_[b].noisy_pixels > 0 ? sums_[b].variance / sums_[b].noisy_pixels : 0;
      const double reference_mean = sums_[b].reference_variance / sums_[b].pixels;
      std::vector<double> ratios;
      for_each_pixel(out_.places[b],
                     [&](int x, int y) { ratios.push_back(mean > 0 ? channel_.variance[index(x, y)] / mean : 0); });
      const double independent = sums_[b].noisy_pixels / shared_.within_blocks;
      const KnownVariance expectation{mean, worth(ratios, independent)};
      // Least squares of the third moments on the cubed deviations: the noisiest pixels count most.
      const double of_one = sums_[b].variance_cubed > 0 ? sums_[b].skewed / sums_[b].variance_cubed : 0;
      const double skewness = std::max(0.0, of_one) / std::sqrt(channel_.images);
      for_each_pixel(out_.places[b], [&](int x, int y) {
        const std::size_t i = index(x, y);
        KnownVariance known = steadied({channel_.variance[i], freedom_}, expectation);
        known.variance /= channel_.images;
        // As in agreement.h: a pixel that met no rare bright sample looks dark and certain.
        const KnownVariance of_reference{std::max(reference_mean, channel_.reference_variance[i]),
                                         known_.reference_freedom};
        pixels[i] = deviation_of(channel_.mean[i], channel_.reference[i], known, of_reference);
        pixels[i].sample = brightest_of(sums_[b]) / channel_.images;
        if (known_.samples)
          pixels[i].standard_error = std::hypot(pixels[i].standard_error, contrast_around(x, y) / *known_.samples);
        // With few images, a block may not have met its bright samples before this pixel did.
        pixels[i].skewness = skewness;
        if (pixels[i].sample > skewness * pixels[i].standard_error)
          pixels[i].skewness = pixels[i].sample / pixels[i].standard_error;
      });
    }
  }

  /// The degrees of freedom of an expectation, from ratios of which `independent` are independent.
  double worth(const std::vector<double>& ratios, double independent) const {
    return std::min(freedom_of_expectation(ratios, freedom_), freedom_ * std::max(0.0, independent - 1));
  }

  /// Variance over the images of the mean over a block.
  double variance_of_block(const Block& block, double mean) const {
    double squares = 0;
    for (const Image* image : images_) {
      double sum = 0;
      for_each_pixel(block, [&](int x, int y) { sum += double{image->rgb[3 * index(x, y) + c_]}; });
      const double off = sum / block.pixels() - mean;
      squares += off * off;
    }
    return squares / freedom_;
  }

  void measure_blocks() {
    std::vector<double> own, ratios;
    for (std::size_t b = 0; b < sums_.size(); ++b) {
      const BlockSums& sums = sums_[b];
      own.push_back(variance_of_block(out_.places[b], sums.mean / sums.pixels));
      const double independent = sums.variance / (sums.pixels * sums.pixels);
      ratios.push_back(independent > 0 ? own.back() / independent : 0);
    }
    const double of_blocks = worth(ratios, out_.independent_blocks[c_]), factor = shared_.within_blocks;
    for (std::size_t b = 0; b < sums_.size(); ++b) {
      const BlockSums& sums = sums_[b];
      // The blocks' own variance already includes the noise that their pixels share.
      const double of_pixels = std::max(
          0.0, freedom_of_sum(freedom_, sums.variance, sums.variance_squared) / factor - (factor > 1 ? freedom_ : 0));
      const KnownVariance expectation{factor * sums.variance / (sums.pixels * sums.pixels),
                                      std::min(of_blocks, of_pixels)};
      KnownVariance known = steadied({own[b], freedom_}, expectation);
      known.variance = std::max(known.variance, sums.least / (sums.pixels * sums.pixels));
      known.variance /= has_fault(Fault::certain_noise) ? channel_.images * channel_.images : channel_.images;
      out_.blocks[c_].push_back(
          deviation_of(sums.mean / sums.pixels, sums.reference / sums.pixels, known, of_reference(sums)));
      out_.blocks[c_].back().sample = factor * brightest_of(sums) / (sums.pixels * channel_.images);
    }
  }

  void measure_whole() {
    const Block all{0, 0, out_.width, out_.height};
    const BlockSums sums = sums_over(all);
    const double mean = sums.mean / sums.pixels;
    out_.whole[c_] = deviation_of(mean, sums.reference / sums.pixels,
                                  {variance_of_block(all, mean) / channel_.images, freedom_}, of_reference(sums));
    out_.whole[c_].sample =
        shared_.within_blocks * brightest_.of_channel * sums.brightness() / (sums.pixels * channel_.images);
  }

  /// The amount that the brightest sample that this block may have missed adds to a pixel of one image.
  double brightest_of(const BlockSums& block) const { return brightest_.missed_by(block.brightness(), brightness_); }

  KnownVariance of_reference(const BlockSums& sums) const {
    return {sums.reference_variance / (sums.pixels * sums.pixels),
            freedom_of_sum(known_.reference_freedom, sums.reference_variance, sums.reference_variance_squared)};
  }

  const Channel& channel_;
  std::span<const Image* const> images_;
  std::size_t c_;
  const KnownNoise& known_;
  Deviations& out_;
  double freedom_;
  SharedNoise shared_;
  double brightness_ = 0;  ///< mean over the image
  BrightestSample brightest_;
  std::vector<BlockSums> sums_;
};

}  // namespace

Deviations measure_deviations(const Rendering& reference, std::span<const Image* const> images,
                              const KnownNoise& known) {
  Deviations out;
  out.width = reference.mean.width;
  out.height = reference.mean.height;
  out.images = images.size();
  out.places = blocks_of(out.width, out.height);
  std::vector<Channel> values;
  for (std::size_t c = 0; c < 3; ++c) values.push_back(channel_of(reference, images, c, known.least_variance));
  std::vector<ChannelDeviations> channels;
  for (std::size_t c = 0; c < 3; ++c) channels.emplace_back(values[c], images, c, known, out);
  BrightestSample brightest;
  for (ChannelDeviations& channel : channels) channel.add_to(brightest);
  for (ChannelDeviations& channel : channels) channel.measure(brightest);
  return out;
}

Image mean_of(std::span<const Image* const> images) {
  Image mean(images.front()->width, images.front()->height);
  for (std::size_t i = 0; i < mean.rgb.size(); ++i) {
    double sum = 0;
    for (const Image* image : images) sum += double{image->rgb[i]};
    mean.rgb[i] = static_cast<float>(sum / static_cast<double>(images.size()));
  }
  return mean;
}

}  // namespace photonproof::inline harness_statistics
