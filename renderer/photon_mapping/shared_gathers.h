// One gather for many samples. The discs of neighbouring samples hold nearly the same photons, so that looking up each
// of them brings little.
//   In a pixel: of k points with weights w_i at which the photons bring E_i, one is drawn with a probability p_i in
//   proportion to w_i's largest channel and stands for all with the weight w_i / p_i. In expectation that is
//   sum w_i E_i, whatever the weights and the irradiances are. Where it takes m discs to cover the pixel, every m-th
//   point shares.
//   In a block of pixels that is small beside the radius: one of the pixels' points is drawn by the same rule, and what
//   is found there counts for all. That blurs E by half a block, evenly since blocks lie elsewhere in every pass: with
//   blocks of r/3 by a 14th of what the gather itself blurs it, r^2/8 times the Laplacian. Points of a block that are
//   further apart than half a radius, on other surfaces or sides of them, or reached by other paths do not share.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/kernels/gather_points.h"

namespace photonproof::inline renderer_photon_mapping {

/// What stands for the points of a pixel that end alike.
struct PixelPoint {
  std::uint32_t pixel;  ///< of the tile, row by row
  GatherPoint point;    ///< its weight: the sum of all weights
  float size;           ///< of the weights' largest channels, summed
};

/// By pixel, in the order of the points' paths. `pixel_of` a path says its pixel; points of one path differ in their
/// edges and never share. The draws are functions of `key` and the points' paths. Points that are further apart than
/// `most_apart` do not share.
std::vector<PixelPoint> points_of_pixels(GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of,
                                         float most_apart, std::uint32_t key);

/// Where they are too far apart to share.
std::vector<PixelPoint> points_by_themselves(const GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of);

/// How pixels share.
struct BlockGrid {
  int size = 1;      ///< pixels a side
  int x = 0, y = 0;  ///< where it starts: a pixel is in the block of (its x + x) / size
};

/// Blocks for gathers of a radius that spans so many pixels, put elsewhere by `key`.
BlockGrid block_grid(double pixels_a_radius, std::uint32_t key);

/// The gathers that a tile's points share; the queue's radii are those of the points that were drawn.
struct SharedGathers {
  GatherQueue queue{0};
  std::vector<std::uint32_t> gather_of;  ///< for each of the points: number in the queue

  /// `radius`: of each of the points' gathers.
  SharedGathers(const std::vector<PixelPoint>& points, const std::vector<float>& radius, const Tile& tile,
                const BlockGrid& grid, std::uint32_t key);
};

}  // namespace photonproof::inline renderer_photon_mapping
