// PNG files through libpng.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {

/// Whether the file begins as a PNG does.
bool is_png(const std::string& path);

/// 8 and 16 bits, palettes and fewer bits as 8; without alpha. Throws InputError; damage shows at the latest when the
/// last row is read.
std::unique_ptr<ImageFile> open_png(const std::string& path);

/// An 8-bit RGB file of sRGB values. `target` is the name that errors give to the file. Throws InputError.
std::unique_ptr<ByteImageWriter> create_png(const std::string& path, const std::string& target, int width, int height);

}  // namespace photonproof::inline scenes_images
