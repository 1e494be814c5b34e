#include "harness/gates/unknown_noise.h"

#include <algorithm>
#include <vector>

#include "harness/statistics/deviations.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr int side = 8;  // pixels of a block, as in gates

/// The variance of the images' mean at an index of Image::rgb; 0 of one image.
double variance_of_mean(std::span<const Image* const> images, const Image& mean, std::size_t at) {
  if (images.size() < 2) return 0;
  double squares = 0;
  for (const Image* image : images) {
    const double off = double{image->rgb[at]} - double{mean.rgb[at]};
    squares += off * off;
  }
  const auto n = static_cast<double>(images.size());
  return squares / (n * (n - 1));
}

class BlockNoise {
 public:
  BlockNoise(const Image& reference, std::span<const Image* const> images)
      : reference_(reference), images_(images), mean_(mean_of(images)) {}

  /// The estimate for the block whose upper left pixel is (x0, y0).
  double of_block(int x0, int y0, int channel) const {
    const int x1 = std::min(x0 + side, mean_.width), y1 = std::min(y0 + side, mean_.height);
    double squares = 0, pairs = 0, noise = 0, pixels = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const double here = difference(x, y, channel);
        noise += variance_of_mean(images_, mean_, index(x, y, channel));
        ++pixels;
        for (const auto& [nx, ny] : {std::pair{x + 1, y}, {x, y + 1}}) {
          if (nx >= x1 || ny >= y1) continue;
          const double step = difference(nx, ny, channel) - here;
          squares += step * step;
          ++pairs;
        }
      }
    return pairs > 0 ? std::max(0.0, squares / (2 * pairs) - noise / pixels) : 0;
  }

 private:
  std::size_t index(int x, int y, int channel) const {
    return static_cast<std::size_t>(mean_.pixel(x, y) - mean_.rgb.data() + channel);
  }
  double difference(int x, int y, int channel) const {
    const std::size_t at = index(x, y, channel);
    return double{reference_.rgb[at]} - double{mean_.rgb[at]};
  }

  const Image& reference_;
  std::span<const Image* const> images_;
  Image mean_;
};

}  // namespace

Rendering with_estimated_noise(const Rendering& reference, std::span<const Image* const> images) {
  Rendering estimated = reference;
  const int width = reference.mean.width, height = reference.mean.height;
  estimated.variance = Image(width, height);
  const BlockNoise noise(reference.mean, images);
  for (int y0 = 0; y0 < height; y0 += side)
    for (int x0 = 0; x0 < width; x0 += side)
      for (int channel = 0; channel < 3; ++channel) {
        const auto variance = static_cast<float>(noise.of_block(x0, y0, channel));
        for (int y = y0; y < std::min(y0 + side, height); ++y)
          for (int x = x0; x < std::min(x0 + side, width); ++x) estimated.variance->pixel(x, y)[channel] = variance;
      }
  return estimated;
}

}  // namespace photonproof::inline harness_gates
