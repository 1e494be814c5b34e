// BMP as students write it by hand, 24 bits a pixel and uncompressed. Read without OpenImageIO, which takes longer to
// load than a small scene to render.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image_file.h"

namespace photonproof::inline harness_submissions {

/// Null for a BMP of another kind. Throws InputError where it is cut off or its header contradicts itself. Source of
/// the layout: the BITMAPINFOHEADER of Windows' GDI documentation.
std::unique_ptr<ImageFile> open_plain_bmp(const std::string& path);

}  // namespace photonproof::inline harness_submissions
