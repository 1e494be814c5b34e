// PPM and PFM, the formats that students write by hand, with comments and exact for every greatest value (OpenImageIO
// makes 65534/65535 of a full 16-bit sample). Read without OpenImageIO, which takes longer to load than a scene to
// render.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image_file.h"

namespace photonproof::inline harness_submissions {

/// P3 and P6 with a greatest value up to 65535, PF and Pf of either byte order. Throws InputError. Damaged or missing
/// data after the header is found only when rows are read.
std::unique_ptr<ImageFile> open_netpbm(const std::string& path);

}  // namespace photonproof::inline harness_submissions
