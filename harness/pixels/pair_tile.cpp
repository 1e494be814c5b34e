#include "harness/pixels/pair_tile.h"

#include <algorithm>
#include <cmath>

#include "harness/pixels/pixel_loops.h"

namespace photonproof::inline harness_pixels {

PairTile::PairTile(const TileGrid& grid, int x0, int y0, const RowBlock& reference, const RowBlock& test,
                   const PixelMask* mask, double exposure, TileMemory& memory)
    : grid_(grid),
      x0_(x0),
      y0_(y0),
      width_(std::min(TileGrid::tile_width, grid.width - x0)),
      height_(std::min(TileGrid::tile_height, grid.height - y0)),
      mask_(mask),
      exposure_(exposure),
      memory_(memory),
      frame_(memory) {
  load(0, reference);
  load(1, test);
}

void PairTile::load(std::size_t which, const RowBlock& rows) {
  for (float*& plane : linear_[which]) plane = memory_.take<float>(padded_size());
  const int left = std::max(0, x0_ - reach), right = std::min(grid_.width, x0_ + width_ + reach);
  const auto before = static_cast<std::size_t>(left - (x0_ - reach));
  const auto inside = static_cast<std::size_t>(right - left);
  for (int y = 0; y < height_ + 2 * reach; ++y) {
    const int source = std::clamp(y0_ - reach + y, 0, grid_.height - 1);
    const float* rgb =
        rows.rgb + 3 * (static_cast<std::size_t>(source - rows.first) * static_cast<std::size_t>(grid_.width) +
                        static_cast<std::size_t>(left));
    std::array<float*, 3> row{};
    for (std::size_t c = 0; c < 3; ++c) row[c] = linear_[which][c] + static_cast<std::size_t>(y) * stride();
    pixel_loops().split_rgb(rgb, inside, row[0] + before, row[1] + before, row[2] + before);
    for (float* first : row) {
      std::fill_n(first, before, first[before]);
      std::fill(first + before + inside, first + stride(), first[before + inside - 1]);
    }
  }
}

PairTile::LinearPlane PairTile::linear(std::size_t which, std::size_t channel) const {
  return {linear_[which][channel], padded_size(), stride()};
}

TileColour PairTile::colour_at(const std::array<double*, 3>& planes, int around) const {
  const std::size_t core = static_cast<std::size_t>(around) * (stride(around) + 1);
  return {TilePlane{planes[0] + core, stride(around)},
          {planes[1] + core, stride(around)},
          {planes[2] + core, stride(around)}};
}

TileColour PairTile::exposed(std::size_t which) const {
  if (!exposed_[which][0]) {
    const double scale = std::exp2(exposure_);
    for (std::size_t c = 0; c < 3; ++c) {
      exposed_[which][c] = memory_.take<double>(padded_size());
      pixel_loops().expose(linear_[which][c], padded_size(), scale, exposed_[which][c]);
    }
  }
  return colour_at(exposed_[which], reach);
}

TileColour PairTile::encoded(std::size_t which) const {
  if (!encoded_[which][0]) {
    for (double*& plane : encoded_[which]) plane = memory_.take<double>(padded_size(encoded_reach));
    const double scale = std::exp2(exposure_);
    const TileMemory::Frame frame(memory_);
    const std::size_t row = stride(encoded_reach), rows = padded_size(encoded_reach) / row;
    auto* exposed = memory_.take<double>(row);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t y = 0; y < rows; ++y) {
        const float* from = linear_[which][c] + (y + reach - encoded_reach) * stride() + (reach - encoded_reach);
        pixel_loops().expose(from, row, scale, exposed);
        pixel_loops().encode(exposed, row, encoded_[which][c] + y * row);
      }
  }
  return colour_at(encoded_[which], encoded_reach);
}

std::span<const float> PairTile::counted(std::size_t which, std::size_t channel) const {
  float*& packed = counted_[which][channel];
  if (!packed) {
    packed = memory_.take<float>(pixels());
    float* end = packed;
    for (int y = 0; y < height_; ++y) {
      const float* row = linear_[which][channel] + static_cast<std::size_t>(y + reach) * stride() + reach;
      if (all_count()) {
        end = std::copy_n(row, width_, end);
        continue;
      }
      for (int x = 0; x < width_; ++x)
        if (counts(x, y)) *end++ = row[x];
    }
    counted_size_ = static_cast<std::size_t>(end - packed);
  }
  return {packed, counted_size_};
}

}  // namespace photonproof::inline harness_pixels
