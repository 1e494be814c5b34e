// Linear pixel values for the page's viewer, packed to fit into the page.
//
// A value v becomes the 16-bit code sign(v) (256 log2|v| + 5121), rounded. With 256 steps an octave it comes back
// within 0.14 % for sizes from 2^-20 to 2^28; smaller ones become 0, larger ones 2^28. NaN and infinities have codes of
// their own. The stored values, modulo 2^16, are green's code and the differences of red's and blue's codes from it,
// since noise mostly changes brightness. Each is stored as its difference to the pixel on its left: positive ones
// doubled, negative ones doubled less one. Six planes of bytes (low and high of green, red, blue) are deflated (zlib's
// format).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_page {

/// The code of a value: 0 for 0 and for values that round to it.
std::int16_t pixel_code(float value);

/// An image as above; zlib's bytes.
std::string packed_pixels(const Image& image);

/// One image of a viewer in base64, or the reason why there is none.
struct PixelData {
  std::string base64;
  std::string flip_base64;    ///< its FLIP map (flip_values.h); empty if there is none of its size
  int width = 0, height = 0;  ///< of the image itself, before it was reduced
  bool from_picture = false;  ///< from an 8-bit picture, since the EXR is missing
  std::string problem;
};

/// An image to show: the EXR, else the picture, which has the scene's exposure.
struct PixelSource {
  std::string image, picture;  ///< relative to the results folder
  std::string flip{};          ///< FLIP map, likewise; may be empty
};

struct PixelDataSet {
  std::vector<PixelData> images;  ///< one for each source
  int reduced_by = 1;             ///< pixels that were averaged into one, in each direction
};

/// An image in memory, or the reason why there is none.
struct LoadedImage {
  std::optional<Image> image;
  std::optional<Image> flip{};  ///< its FLIP map, of the same size
  bool from_picture = false;    ///< from an 8-bit picture, since the EXR is missing
  std::string problem{};
};

/// All images, reduced by the smallest whole factor that keeps their base64 within `allowance` bytes.
PixelDataSet pixel_data(const std::vector<LoadedImage>& images, std::size_t allowance);

/// All images of a scene, reduced by the smallest whole factor that keeps their base64 within `allowance` bytes.
PixelDataSet pixel_data(const std::filesystem::path& folder, const std::vector<PixelSource>& sources, double exposure,
                        std::size_t allowance);

}  // namespace photonproof::reports::inline reports_page
