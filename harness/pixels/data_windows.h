// Aligns files that store only a part of their image, such as renders with a crop.
#pragma once

#include <optional>
#include <string>

#include "harness/pixels/pixel_region.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// The pixels of two images that are compared.
struct ComparedPart {
  ImageWindow part = ImageWindow::displayed;  ///< how both files are read
  /// Region in the images as read; empty: all pixels. Set where both files store the same part of equal images.
  std::optional<PixelRegion> region;
  std::string note;  ///< a sentence for the user if only one file stores some pixels; empty: none
};

/// Parts of equal size are compared pixel by pixel if only one file names the image that it is a part of. Otherwise
/// images are compared as displayed, black where a file stores nothing. Throws InputError as ImageRows does.
ComparedPart compared_part(const std::string& reference, const std::string& test, const std::string& layer = "");

}  // namespace photonproof::inline harness_pixels
