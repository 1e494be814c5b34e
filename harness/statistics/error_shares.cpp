#include "harness/statistics/error_shares.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/image_blocks.h"
#include "harness/statistics/gate_tiles.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr int most_tiles_a_side = 8;
constexpr std::size_t most_images = 4;
constexpr std::size_t most_shares_named = 3;
constexpr double named_over_even = 2;
constexpr int least_window = 11;  // pixels, of ssim

/// The row of the metric whose tile values locate this metric's error.
const MetricRow& metric_row(const std::string& metric) {
  const MetricRow* row = find_metric(metric);
  return row->shares.by ? *find_metric(row->shares.by) : *row;
}

/// A tile's pixels with half a window around them, within the image.
PixelRegion region_of(const Block& tile, bool windows, int width, int height) {
  if (!windows) return {tile.x0, tile.y0, tile.x1 - tile.x0, tile.y1 - tile.y0};
  const auto range = [](int from, int to, int size) {
    int low = std::max(0, from - least_window / 2), high = std::min(size, to + least_window / 2);
    if (high - low < least_window) low = std::max(0, high - least_window);
    if (high - low < least_window) high = std::min(size, low + least_window);
    return std::pair(low, high);
  };
  const auto [x0, x1] = range(tile.x0, tile.x1, width);
  const auto [y0, y1] = range(tile.y0, tile.y1, height);
  return {x0, y0, x1 - x0, y1 - y0};
}

std::string relative_to(const Image& reference, std::span<const Image* const> images, const Block& tile) {
  double expected = 0, found = 0;
  for_each_pixel(tile, [&](int x, int y) {
    for (int c = 0; c < 3; ++c) {
      expected += double{reference.pixel(x, y)[c]};
      for (const Image* image : images) found += double{image->pixel(x, y)[c]} / static_cast<double>(images.size());
    }
  });
  return relative_text(found - expected, expected);
}

}  // namespace

int share_tile_side(int width, int height) {
  const int side = (std::max(width, height) + most_tiles_a_side - 1) / most_tiles_a_side;
  return std::max(block_side, side);
}

std::vector<FailingTile> largest_error_shares(const std::string& metric, const Image& reference,
                                              std::span<const Image* const> images, MetricOptions options) {
  images = images.first(std::min(images.size(), most_images));
  const MetricRow& row = metric_row(metric);
  options.only = {row.name};
  options.also.clear();
  const int side = share_tile_side(reference.width, reference.height);
  std::vector<Block> tiles;
  std::vector<double> losses;
  for (int y = 0; y < reference.height; y += side)
    for (int x = 0; x < reference.width; x += side) {
      const Block tile{x, y, std::min(x + side, reference.width), std::min(y + side, reference.height)};
      options.region = region_of(tile, row.shares.windows, reference.width, reference.height);
      double loss = 0;
      for (const Image* image : images)
        for (const MetricValue& value : compute_metrics(reference, *image, options))
          loss += row.shares.loss(value.value);
      tiles.push_back(tile);
      losses.push_back(row.shares.greatest ? loss : loss * tile.pixels());
    }
  const double sum = std::accumulate(losses.begin(), losses.end(), 0.0);
  std::vector<std::size_t> order(tiles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return losses[a] > losses[b]; });
  std::vector<FailingTile> named;
  for (const std::size_t i : order) {
    const double share = sum > 0 ? losses[i] / sum : 0;
    const bool stands_out = share * static_cast<double>(tiles.size()) > named_over_even;
    if (share <= 0 || named.size() == most_shares_named || (!named.empty() && (!stands_out || row.shares.greatest)))
      break;
    const Block& tile = tiles[i];
    FailingTile out{tile.x0, tile.y0, tile.x1 - tile.x0, tile.y1 - tile.y0, share, {}};
    const std::string part =
        row.shares.greatest ? "the greatest error" : fmt::format("{:.2g} % of the error", 100 * share);
    out.sentence = fmt::format("{} in {} x {} px at ({}, {}), where the image is {}", part, out.width, out.height,
                               out.x, out.y, relative_to(reference, images, tile));
    named.push_back(std::move(out));
  }
  return named;
}

}  // namespace photonproof::inline harness_statistics
