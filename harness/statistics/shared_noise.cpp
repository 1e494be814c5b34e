#include "harness/statistics/shared_noise.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <vector>

#include "harness/pixels/image_blocks.h"

namespace photonproof::inline harness_statistics {
namespace {

/// One block's mean in every image, less their mean; and the variance that independent pixels give it.
struct BlockNoise {
  std::vector<double> off;
  double of_pixels = 0;
  double squares() const {
    double sum = 0;
    for (const double value : off) sum += value * value;
    return sum;
  }
};

BlockNoise noise_of(const Block& block, std::span<const Image* const> images, std::size_t channel,
                    const Image* variance) {
  const auto count = static_cast<double>(images.size());
  BlockNoise noise{std::vector<double>(images.size()), 0};
  for_each_pixel(block, [&](int x, int y) {
    double mean = 0, squares = 0;
    for (const Image* image : images) mean += double{image->pixel(x, y)[channel]} / count;
    for (std::size_t k = 0; k < images.size(); ++k) {
      const double off = double{images[k]->pixel(x, y)[channel]} - mean;
      squares += off * off;
      noise.off[k] += off / block.pixels();
    }
    noise.of_pixels += variance != nullptr ? double{variance->pixel(x, y)[channel]} : squares / (count - 1);
  });
  noise.of_pixels /= block.pixels() * block.pixels();
  return noise;
}

/// Sum of the squared correlation over the images, for all pairs of blocks and blocks with themselves. A matrix of K
/// rows and one normalised column a block has the same sum over its rows: K x K products in place of B x B.
double squared_correlations(const std::vector<BlockNoise>& blocks, std::size_t images) {
  std::vector<double> products(images * images);
  for (const BlockNoise& block : blocks) {
    const double squares = block.squares();
    for (std::size_t i = 0; i < images; ++i)
      for (std::size_t j = 0; j < images; ++j) products[i * images + j] += block.off[i] * block.off[j] / squares;
  }
  double sum = 0;
  for (const double product : products) sum += product * product;
  return sum;
}

double independent_of(const std::vector<BlockNoise>& blocks, std::size_t images) {
  const auto count = static_cast<double>(blocks.size()), freedom = static_cast<double>(images) - 1;
  if (blocks.size() < 2 || freedom < 2) return count;
  const double pairs = squared_correlations(blocks, images) - count;
  const double by_chance = count * (count - 1) / freedom;
  const double shared = std::max(0.0, (pairs - by_chance) * freedom / (freedom - 1));
  return std::clamp(count * count / (count + shared), 1.0, count);
}

double upper_quantile(double freedom, double level) {
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(freedom), level));
}

/// With independent blocks, sum r^2 / B spreads as chi^2 does over the symmetric matrices without a trace.
double freedom_of_correlations(std::size_t images) {
  const double rank = static_cast<double>(images) - 1;
  return rank * (rank + 1) / 2 - 1;
}

}  // namespace

bool SharedNoise::is_within_blocks(double level) const {
  return blocks > 0 && within_blocks > upper_quantile(freedom(), level) / freedom();
}

double SharedNoise::surely_independent() const {
  const auto count = static_cast<double>(blocks);
  const double rank = static_cast<double>(images) - 1, freedom = freedom_of_correlations(images);
  if (blocks < 2 || freedom < 1) return count;
  const double shared = count / independent_blocks - 1;
  return std::max(1.0, count / (1 + shared * (1 + std::sqrt(2 / rank)) + std::sqrt(2 / freedom) * rank / (rank - 1)));
}

bool SharedNoise::is_between_blocks(double level) const {
  const double rank = static_cast<double>(images) - 1, freedom = freedom_of_correlations(images);
  if (blocks < 2 || freedom < 1) return false;
  const auto count = static_cast<double>(blocks);
  return count / independent_blocks > 1 + (upper_quantile(freedom, level) / freedom - 1) * rank / (rank - 1);
}

SharedNoise shared_noise(std::span<const Image* const> images, std::size_t channel, const Image* variance) {
  std::vector<BlockNoise> noisy;
  double ratios = 0;
  for (const Block& block : blocks_of(images.front()->width, images.front()->height)) {
    BlockNoise noise = noise_of(block, images, channel, variance);
    if (!(noise.of_pixels > 0) || !(noise.squares() > 0)) continue;
    ratios += noise.squares() / (static_cast<double>(images.size()) - 1) / noise.of_pixels;
    noisy.push_back(std::move(noise));
  }
  SharedNoise shared{images.size(), noisy.size()};
  if (noisy.empty()) return shared;
  shared.within_blocks = ratios / static_cast<double>(noisy.size());
  shared.independent_blocks = independent_of(noisy, images.size());
  return shared;
}

SharedNoise shared_noise(std::span<const Image* const> images, const Image* variance) {
  SharedNoise most = shared_noise(images, 0, variance);
  for (const std::size_t channel : {std::size_t{1}, std::size_t{2}}) {
    const SharedNoise other = shared_noise(images, channel, variance);
    const bool between = other.is_between_blocks() || most.is_between_blocks();
    if (between ? other.independent_blocks < most.independent_blocks : other.within_blocks > most.within_blocks)
      most = other;
  }
  return most;
}

}  // namespace photonproof::inline harness_statistics
