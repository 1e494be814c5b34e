// PPM and PFM, the formats that are written by hand, with comments and exact for every greatest value (OpenImageIO
// makes 65534/65535 of a full 16-bit sample). Read without OpenImageIO, which takes longer to load than a small scene
// to render.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image.h"
#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {

/// P3 and P6 with a greatest value up to 65535, PF and Pf of either byte order, whose scale is ignored. Throws
/// InputError. Damaged or missing data after the header is found only when rows are read.
std::unique_ptr<ImageFile> open_netpbm(const std::string& path);

/// The same for a PFM file without a scale, that is, of scale 1 or -1. A file too short for its size is refused here,
/// before memory is taken for it. Null for any other file.
std::unique_ptr<ImageFile> open_plain_pfm(const std::string& path);

/// A PFM of R, G and B, lowest row first, little-endian, of scale 1. It is written beside the target and renamed.
/// Throws InputError when it cannot be written.
void write_pfm(const std::string& path, const Image& image);

}  // namespace photonproof::inline scenes_images
