// Linear pixel values for the page's viewer, small enough to be inside it.
//
// A value v becomes the 16-bit code sign(v) (256 log2|v| + 5121), rounded: 256 steps an octave, so it comes back within
// 0.14 %, whatever its size from 2^-20 to 2^28; smaller ones become 0, larger ones 2^28. NaN and infinities have codes
// of their own. What is stored, modulo 2^16, is green's code and how far red's and blue's are from it (noise mostly
// changes brightness), each as its difference to the pixel on its left, positive ones doubled, negative ones doubled
// less one; six planes of bytes, low and high of green, red, blue; deflated (zlib's format).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_page {

/// The code of a value: 0 for 0 and what rounds to it.
std::int16_t pixel_code(float value);

/// An image as above; zlib's bytes.
std::string packed_pixels(const Image& image);

/// One image of a viewer, in base64, or why there is none.
struct PixelData {
  std::string base64;
  std::string flip_base64;    ///< its FLIP map (flip_values.h); empty where there is none of its size
  int width = 0, height = 0;  ///< of the image itself, before it was reduced
  bool from_picture = false;  ///< from an 8-bit picture, for want of the EXR
  std::string problem;
};

/// An image to be shown: the EXR, or else the picture, which shows it at the scene's exposure.
struct PixelSource {
  std::string image, picture;  ///< relative to the results folder
  std::string flip{};          ///< FLIP map, likewise; may be empty
};

struct PixelDataSet {
  std::vector<PixelData> images;  ///< one for each source
  int reduced_by = 1;             ///< pixels that became one, in each direction
};

/// All images of a scene, reduced by the smallest whole factor that keeps their base64 within `allowance` bytes.
PixelDataSet pixel_data(const std::filesystem::path& folder, const std::vector<PixelSource>& sources, double exposure,
                        std::size_t allowance);

}  // namespace photonproof::reports::inline reports_page
