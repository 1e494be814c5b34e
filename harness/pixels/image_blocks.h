// Blocks of 8 x 8 pixels, over which tests of images take means to find a small bias over a wide area.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace photonproof::inline harness_pixels {

inline constexpr int block_side = 8;

/// Pixels [x0, x1) x [y0, y1), with smaller blocks at the right and lower edges.
struct Block {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double pixels() const { return static_cast<double>(x1 - x0) * (y1 - y0); }
};

/// Row by row.
inline std::vector<Block> blocks_of(int width, int height) {
  std::vector<Block> blocks;
  for (int y = 0; y < height; y += block_side)
    for (int x = 0; x < width; x += block_side)
      blocks.push_back({x, y, std::min(x + block_side, width), std::min(y + block_side, height)});
  return blocks;
}

/// visit(x, y)
template <class Visit>
void for_each_pixel(const Block& block, const Visit& visit) {
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) visit(x, y);
}

}  // namespace photonproof::inline harness_pixels
