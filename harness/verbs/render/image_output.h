// The formats of images that `render` writes, by the ending of the name.
#pragma once

#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs_render {

enum class ImageFormat { exr, pfm, png };

/// The format of a name that ends in .exr, .pfm or .png, in small letters. Throws InputError for any other.
ImageFormat output_format(const std::string& name);

/// An EXR has all that there is. A PFM has the mean alone. A PNG has 2^exposure times the mean in 8 bits of sRGB. Of an
/// image that is a part, a PFM and a PNG hold the part. Throws InputError when it cannot be written.
void write_image(const std::string& path, const Rendering& image, double exposure);

}  // namespace photonproof::inline harness_verbs_render
