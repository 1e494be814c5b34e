// Multi-scale structural similarity: Wang, Simoncelli, Bovik, "Multi-scale structural similarity for image quality
// assessment", Asilomar 2003, eq. 7, with the weights published there. Values are display-encoded. Each scale is the
// mean of 2 x 2 values of the previous one; an odd side repeats its last value. The windows are those of ssim; only
// windows inside a scale's image count. Scales 1 to 4 enter by the mean of contrast times structure, scale 5 by the
// mean of all three terms. The result is prod_j cs_j^w_j ssim_5^w_5 for each channel, then the mean over the three
// channels.

#include "harness/metrics/metric_ms_ssim.h"

#include <algorithm>
#include <cmath>

#include "harness/metrics/metric_rows.h"
#include "harness/metrics/metric_windows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

constexpr std::array<double, 5> kWeights = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr int kCoarseScales = 4;

int half(int size) { return (size + 1) / 2; }

}  // namespace

CoarseScale::CoarseScale(int width, int height) : width_(width), height_(height) {}

double CoarseScale::windows() const {
  return static_cast<double>(width_ - 2 * ssim_radius) * static_cast<double>(height_ - 2 * ssim_radius);
}

void CoarseScale::reserve_rows(int end) {
  const auto size = static_cast<std::size_t>(end - first_) * static_cast<std::size_t>(width_);
  for (auto& plane : planes_)
    if (plane.size() < size) plane.resize(size);
}

double* CoarseScale::at(std::size_t which, std::size_t channel, int x, int y) {
  return planes_[3 * which + channel].data() + static_cast<std::size_t>(y - first_) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(x);
}

CoarseScale::Sums CoarseScale::measure_tile(int x0, int y0, TileMemory& memory, CoarseScale* next) {
  const int width = std::min(TileGrid::tile_width, width_ - x0), height = std::min(TileGrid::tile_height, height_ - y0);
  constexpr int r = ssim_radius;
  const auto stride = static_cast<std::size_t>(width + 2 * r);
  Sums sums{};
  const InnerRange columns = inner_range(x0, width, width_), rows = inner_range(y0, height, height_);
  for (std::size_t c = 0; c < 3; ++c) {
    const TileMemory::Frame frame(memory);
    TilePlane padded[2];
    for (std::size_t which = 0; which < 2; ++which) {
      auto* plane = memory.take<double>(stride * static_cast<std::size_t>(height + 2 * r));
      padded[which] = {plane + r * stride + r, stride};
      for (int y = y0 - r; y < y0 + height + r; ++y) {
        const double* row = at(which, c, 0, std::clamp(y, 0, height_ - 1));
        for (int x = x0 - r; x < x0 + width + r; ++x) *plane++ = row[std::clamp(x, 0, width_ - 1)];
      }
      if (next)
        halve(padded[which], static_cast<std::size_t>(half(width)), static_cast<std::size_t>(half(height)),
              next->at(which, c, x0 / 2, y0 / 2), static_cast<std::size_t>(next->width()));
    }
    if (columns.first >= columns.end) continue;
    SimilarityRows similarity(padded[0].at(columns.first, rows.first), padded[1].at(columns.first, rows.first),
                              columns.count(), memory);
    for (int y = rows.first; y < rows.end; ++y) {
      similarity.next();
      sums[c] += lane_sum(columns.count(), [&](std::size_t i) { return similarity.ssim()[i]; });
      sums[3 + c] += lane_sum(columns.count(), [&](std::size_t i) { return similarity.structure()[i]; });
    }
  }
  return sums;
}

void CoarseScale::advance(int ready, const ParallelLoop& loop, CoarseScale* next) {
  // A band of tiles needs ssim_radius more rows, where the image has them.
  int end = measured_;
  while (end < height_ && (ready == height_ || end + TileGrid::tile_height + ssim_radius <= ready))
    end = std::min(end + TileGrid::tile_height, height_);
  if (end == measured_) return;
  if (next) next->reserve_rows(half(end));

  const int across = TileGrid{width_, height_}.across();
  const int bands = (end - measured_ + TileGrid::tile_height - 1) / TileGrid::tile_height;
  std::vector<Sums> parts(static_cast<std::size_t>(across) * static_cast<std::size_t>(bands));
  loop(parts.size(), [&](std::size_t i, TileMemory& memory) {
    const auto tile = static_cast<int>(i);
    parts[i] = measure_tile(tile % across * TileGrid::tile_width, measured_ + tile / across * TileGrid::tile_height,
                            memory, next);
  });
  for (const Sums& part : parts)
    for (std::size_t i = 0; i < part.size(); ++i) sums_[i] += part[i];
  measured_ = end;

  const int keep = std::max(first_, end - ssim_radius);
  const auto gone = static_cast<std::size_t>(keep - first_) * static_cast<std::size_t>(width_);
  for (auto& plane : planes_) plane.erase(plane.begin(), plane.begin() + static_cast<std::ptrdiff_t>(gone));
  first_ = keep;
}

bool CoarseScales::possible(const PairFacts& pair) {
  int width = pair.width, height = pair.height;
  for (int scale = 0; scale < kCoarseScales; ++scale) width = half(width), height = half(height);
  return width >= ssim_window && height >= ssim_window && !pair.masked;
}

CoarseScales::CoarseScales(int width, int height) : height_(height) {
  for (int scale = 0; scale < kCoarseScales; ++scale) {
    width = half(width), height = half(height);
    scales_.emplace_back(width, height);
  }
}

void CoarseScales::rows_begin(int, int end) { scales_[0].reserve_rows(half(end)); }

void CoarseScales::put(const PairTile& tile) {
  for (std::size_t which = 0; which < 2; ++which) {
    const TileColour colour = tile.encoded(which);
    for (std::size_t c = 0; c < 3; ++c)
      halve(colour[c], static_cast<std::size_t>(half(tile.width())), static_cast<std::size_t>(half(tile.height())),
            scales_[0].at(which, c, tile.x0() / 2, tile.y0() / 2), static_cast<std::size_t>(scales_[0].width()));
  }
}

void CoarseScales::rows_done(int y, const ParallelLoop& loop) {
  int ready = y == height_ ? scales_[0].height() : y / 2;
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    CoarseScale* next = i + 1 < scales_.size() ? &scales_[i + 1] : nullptr;
    scales_[i].advance(ready, loop, next);
    const int measured = scales_[i].measured_rows();
    if (next) ready = measured == scales_[i].height() ? next->height() : measured / 2;
  }
}

std::optional<double> CoarseScales::ms_ssim(const std::array<double, 3>& first_structure) const {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, 5> terms{first_structure[c]};
    for (std::size_t i = 0; i < scales_.size(); ++i)
      terms[i + 1] = i + 1 < scales_.size() ? scales_[i].mean_structure(c) : scales_[i].mean_ssim(c);
    double product = 1;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (terms[i] < 0) return std::nullopt;
      product *= std::pow(terms[i], kWeights[i]);
    }
    sum += product;
  }
  return sum / 3;
}

std::string ms_ssim_parameters() {
  return ssim_parameters() + ", scales=5, weights=0.0448 0.2856 0.3001 0.2363 0.1333";
}

}  // namespace photonproof::inline harness_metrics
