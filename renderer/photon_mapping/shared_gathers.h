// One gather for many samples. The discs of neighbouring samples hold nearly the same photons, so that a gather for
// each sample gains little.
//   In a pixel, one of k points is drawn and stands for all. The points have weights w_i, and their photons bring E_i.
//   The probability p_i is in proportion to w_i's largest channel; the point drawn gets the weight w_i / p_i. In
//   expectation that is sum w_i E_i, whatever the weights and the irradiances are. Where it takes m discs to cover
//   the pixel, every m-th point shares.
//   In a block of pixels that is small beside the radius, one of the pixels' points is drawn by the same rule. Its
//   photons count for all. That blurs E by half a block, evenly since blocks lie elsewhere in every pass. The gather
//   itself blurs by r^2/8 times the Laplacian; blocks of r/3 add a 14th of that. Points of a block do not share when
//   they are further apart than half a radius, on other surfaces or sides, or reached by other paths.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/kernels/gather_points.h"

namespace photonproof::inline renderer_photon_mapping {

/// The point that represents the points of a pixel that end alike.
struct PixelPoint {
  std::uint32_t pixel;  ///< number in the tile, row by row
  GatherPoint point;    ///< the point; its weight is the sum of all weights
  float size;           ///< sum of the weights' largest channels
};

/// Points by pixel, in the order of their paths. `pixel_of` gives the pixel of each path. Points of one path differ in
/// their edges and never share. Random numbers depend on `key` and the points' paths. Points further apart than
/// `most_apart` do not share.
std::vector<PixelPoint> points_of_pixels(GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of,
                                         float most_apart, std::uint32_t key);

/// Points that are too far apart to share.
std::vector<PixelPoint> points_by_themselves(const GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of);

/// Blocks of pixels that share.
struct BlockGrid {
  int size = 1;      ///< pixels a side of a block
  int x = 0, y = 0;  ///< offset of the grid: pixel px is in block (px + x) / size
};

/// Blocks for gathers of a radius that spans so many pixels; `key` shifts the grid.
BlockGrid block_grid(double pixels_a_radius, std::uint32_t key);

/// The gathers that a tile's points share; the queue's radii are those of the points drawn.
struct SharedGathers {
  GatherQueue queue{0};
  std::vector<std::uint32_t> gather_of;  ///< for each of the points: number of its gather in the queue

  /// `radius` holds the gather radius of each of the points.
  SharedGathers(const std::vector<PixelPoint>& points, const std::vector<float>& radius, const Tile& tile,
                const BlockGrid& grid, std::uint32_t key);
};

}  // namespace photonproof::inline renderer_photon_mapping
