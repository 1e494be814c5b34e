// Light that light paths bring to the image, wherever that is. Each chunk of paths collects its own, and chunks are
// added in their order, so that sums do not depend on threads.
#pragma once

#include <vector>

#include "renderer/world.h"
#include "scenes/image.h"

namespace photonproof {

struct Splat {
  Vec2<float> raster;
  Rgb value;
};
using Splats = std::vector<Splat>;

/// The sums of one pass over the image.
class SplatImage {
 public:
  SplatImage(int width, int height) : width_(width), height_(height), sums_(std::size_t(width) * std::size_t(height)) {}

  /// Adds them to the pixels whose reconstruction filter reaches them.
  void add(const Splats& splats);
  const RgbD& sum(int x, int y) const { return sums_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }
  void clear() { std::fill(sums_.begin(), sums_.end(), RgbD(0.0)); }

 private:
  int width_, height_;
  std::vector<RgbD> sums_;
};

}  // namespace photonproof
