// A rectangle of an image pair with what lies around it: what every metric looks at, one tile at a time. Planes are
// made at first use and shared by the metrics.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/pixels/pixel_mask.h"

namespace photonproof::inline harness_pixels {

/// Buffers handed out again and again, so that no tile waits for fresh memory.
class TileMemory {
 public:
  /// Lasts as long as the Frame it was taken in.
  template <class T>
  T* take(std::size_t count);

  /// Gives back what was taken since it was made.
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

/// One channel in doubles, row by row. `core` is the tile's first pixel; rows and columns around it are there as far as
/// the plane reaches.
struct TilePlane {
  const double* core;
  std::size_t stride;

  /// From the tile's pixel (x, y) on.
  TilePlane at(int x, int y) const { return {core + static_cast<std::ptrdiff_t>(stride) * y + x, stride}; }
};
using TileColour = std::array<TilePlane, 3>;

/// Rows of an image in memory, interleaved RGB.
struct RowBlock {
  const float* rgb = nullptr;
  int first = 0;  ///< the row that rgb begins with
};

/// Where an image pair's tiles are cut.
struct TileGrid {
  static constexpr int tile_width = 128, tile_height = 128;
  int width, height;
  int across() const { return (width + tile_width - 1) / tile_width; }
};

class PairTile {
 public:
  /// How far planes go beyond the tile: the radius of FLIP's widest filter. Beyond the image the nearest pixel stands.
  static constexpr int reach = 10;
  /// What ssim needs.
  static constexpr int encoded_reach = 5;

  /// Pixels [x0, x0 + width) x [y0, y0 + height) of images of the grid's size. The blocks hold at least its rows and
  /// `reach` more each way, as far as the image has them. `mask` may be null. All must outlive the tile.
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
  /// Whether the pixel counts, of the tile's own coordinates.
  bool counts(int x, int y) const { return !mask_ || mask_->at(x0_ + x, y0_ + y); }
  bool all_count() const { return !mask_; }

  /// Linear values of the pixels that count, row after row, a channel each.
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
  /// And sRGB-encoded, with `encoded_reach`.
  TileColour encoded(std::size_t which) const;

  /// For what a metric needs beside; a Frame of it must not hold a plane's first use.
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
