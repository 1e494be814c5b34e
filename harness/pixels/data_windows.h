// Files that store a part of their image, as renders with a crop do, beside each other.
#pragma once

#include <optional>
#include <string>

#include "harness/pixels/pixel_region.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// The pixels of two images that are compared.
struct ComparedPart {
  ImageWindow part = ImageWindow::displayed;  ///< how both files are read
  /// Of the images so read; empty: all. The part that both files store, where that is the same part of equal images.
  std::optional<PixelRegion> region;
  std::string note;  ///< a sentence for the user where only one file stores some pixels; empty: none
};

/// Parts of equal size are compared pixel by pixel where only one file says of which image it is a part. Otherwise
/// images are compared as displayed, black where a file stores nothing. Throws InputError as ImageRows does.
ComparedPart compared_part(const std::string& reference, const std::string& test, const std::string& layer = "");

}  // namespace photonproof::inline harness_pixels
