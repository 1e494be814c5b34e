// A rectangle of an image pair with its surroundings, so that every metric works tile by tile. Planes are made at first
// use and shared by the metrics.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/pixels/pixel_mask.h"

namespace photonproof::inline harness_pixels {

/// Buffers that are used again and again, so that no tile has to allocate memory.
class TileMemory {
 public:
  /// Lasts as long as the Frame it was taken in.
  template <class T>
  T* take(std::size_t count);

  /// Returns the memory that was taken since the frame was made.
  class Frame {
   public:
    explicit Frame(TileMemory& memory) : memory_(memory), used_(memory.used_) {}
    ~Frame() { memory_.used_ = used_; }
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

   private:
    TileMemory& memory_;
    std::size_t used_;
  };

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  std::vector<std::vector<Line>> blocks_;
  std::size_t used_ = 0;
};

/// One channel in doubles, row by row. `core` is the tile's first pixel, with rows and columns around it as far as the
/// plane reaches.
struct TilePlane {
  const double* core;
  std::size_t stride;

  /// The part of the plane from the tile's pixel (x, y) on.
  TilePlane at(int x, int y) const { return {core + static_cast<std::ptrdiff_t>(stride) * y + x, stride}; }
};
using TileColour = std::array<TilePlane, 3>;

/// Rows of an image in memory, interleaved RGB.
struct RowBlock {
  const float* rgb = nullptr;
  int first = 0;  ///< the row that rgb begins with
};

/// The grid that cuts an image pair into tiles.
struct TileGrid {
  static constexpr int tile_width = 128, tile_height = 128;
  int width, height;
  int across() const { return (width + tile_width - 1) / tile_width; }
};

class PairTile {
 public:
  /// How far planes extend beyond the tile: the radius of FLIP's widest filter. Beyond the image the nearest pixel is
  /// repeated.
  static constexpr int reach = 10;
  /// The reach that ssim needs.
  static constexpr int encoded_reach = 5;

  /// Pixels [x0, x0 + width) x [y0, y0 + height) of images of the grid's size. The blocks hold at least its rows and
  /// `reach` more rows each way, within the image. `mask` may be null. All must outlive the tile.
  PairTile(const TileGrid& grid, int x0, int y0, const RowBlock& reference, const RowBlock& test, const PixelMask* mask,
           double exposure, TileMemory& memory);
  PairTile(const PairTile&) = delete;
  PairTile& operator=(const PairTile&) = delete;

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int image_width() const { return grid_.width; }
  int image_height() const { return grid_.height; }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  /// Whether the pixel at the tile's own coordinates counts.
  bool counts(int x, int y) const { return !mask_ || mask_->at(x0_ + x, y0_ + y); }
  bool all_count() const { return !mask_; }

  /// Linear values of the pixels that count, row after row, for each channel.
  std::span<const float> reference(std::size_t channel) const { return counted(0, channel); }
  std::span<const float> test(std::size_t channel) const { return counted(1, channel); }

  /// Linear values with all of `reach` around them; which = 0 is the reference, 1 the test image.
  struct LinearPlane {
    const float* first;  ///< the upper left value, `reach` pixels left of and above the tile
    std::size_t size;    ///< in all
    std::size_t stride;
  };
  LinearPlane linear(std::size_t which, std::size_t channel) const;
  /// Scaled by 2^exposure and clamped to [0,1], still linear, with `reach`.
  TileColour exposed(std::size_t which) const;
  /// The same, sRGB-encoded, with `encoded_reach`.
  TileColour encoded(std::size_t which) const;

  /// Memory for a metric's own data. No Frame of it may be open when a plane is first used.
  TileMemory& memory() const { return memory_; }

 private:
  std::span<const float> counted(std::size_t which, std::size_t channel) const;
  void load(std::size_t which, const RowBlock& rows);
  std::size_t stride(int around = reach) const { return static_cast<std::size_t>(width_ + 2 * around); }
  std::size_t padded_size(int around = reach) const {
    return stride(around) * static_cast<std::size_t>(height_ + 2 * around);
  }
  TileColour colour_at(const std::array<double*, 3>& planes, int around) const;

  TileGrid grid_;
  int x0_, y0_, width_, height_;
  const PixelMask* mask_;
  double exposure_;
  TileMemory& memory_;
  TileMemory::Frame frame_;
  std::array<std::array<float*, 3>, 2> linear_{};
  mutable std::array<std::array<double*, 3>, 2> exposed_{}, encoded_{};
  mutable std::array<std::array<float*, 3>, 2> counted_{};
  mutable std::size_t counted_size_ = 0;
};

template <class T>
T* TileMemory::take(std::size_t count) {
  if (used_ == blocks_.size()) blocks_.emplace_back();
  std::vector<Line>& block = blocks_[used_++];
  const std::size_t lines = (count * sizeof(T) + sizeof(Line) - 1) / sizeof(Line);
  if (block.size() < lines) block.resize(lines);
  return reinterpret_cast<T*>(block.data());
}

}  // namespace photonproof::inline harness_pixels
