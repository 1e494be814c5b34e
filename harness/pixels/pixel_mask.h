// The pixels that a comparison counts: one bit a pixel.
#pragma once

#include <cstdint>
#include <vector>

namespace photonproof::inline harness_pixels {

class PixelMask {
 public:
  PixelMask(int width, int height)
      : width_(width), height_(height), bits_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  int width() const { return width_; }
  int height() const { return height_; }
  bool at(int x, int y) const { return bits_[index(x, y)]; }
  void set(int x, int y) {
    counted_ += bits_[index(x, y)] ? 0 : 1;
    bits_[index(x, y)] = true;
  }
  std::uint64_t counted() const { return counted_; }  ///< pixels that are set

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<bool> bits_;
  std::uint64_t counted_ = 0;
};

}  // namespace photonproof::inline harness_pixels
