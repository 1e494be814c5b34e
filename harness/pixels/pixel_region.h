// A rectangle of pixels.
#pragma once

#include <string>

namespace photonproof::inline harness_pixels {

/// A part of an image, from its upper left corner.
struct PixelRegion {
  int x = 0, y = 0, width = 0, height = 0;
  /// "x y width height"
  std::string text() const {
    std::string words;
    for (const int number : {x, y, width, height}) words += (words.empty() ? "" : " ") + std::to_string(number);
    return words;
  }
};

}  // namespace photonproof::inline harness_pixels
