// Light that light paths add to the image, at any place. Each unit of work collects its own splats, and units are added
// in their order, so that sums do not depend on threads.
#pragma once

#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/sensor/reconstruction_filter.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_sensor {

struct Splat {
  Vec2<float> raster;
  Rgb value;
};
using Splats = std::vector<Splat>;

/// The sums of one pass over a window of the image.
class SplatImage {
 public:
  SplatImage(const Tile& window, const ReconstructionFilter& filter)
      : window_(window), filter_(filter), sums_(std::size_t(window.width()) * std::size_t(window.height())) {}
  /// Splats stay within a film of this size: pixels whose filter reaches beyond it weigh the part within more.
  SplatImage(const Tile& window, const ReconstructionFilter& filter, int film_width, int film_height);

  /// Adds them to the pixels whose reconstruction filter reaches them.
  void add(const Splats& splats);
  /// Adds to one pixel.
  void add(int x, int y, const RgbD& value) { sums_[index(x, y)] += value; }
  const RgbD& sum(int x, int y) const { return sums_[index(x, y)]; }
  void clear() { std::fill(sums_.begin(), sums_.end(), RgbD(0.0)); }
  /// For checkpoints.
  std::vector<RgbD>& sums() { return sums_; }

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y - window_.y0) * std::size_t(window_.width()) + std::size_t(x - window_.x0);
  }

  Tile window_;
  FilterKernel filter_;
  std::vector<double> column_factors_, row_factors_;  ///< of the window; empty: 1
  std::vector<RgbD> sums_;
};

}  // namespace photonproof::inline renderer_sensor
