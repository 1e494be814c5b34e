// EXR files through OpenEXR.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image.h"
#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {

/// Whether the file begins as an EXR does.
bool is_exr(const std::string& path);

/// The part of an EXR that holds its colour (choose_colour), in scan lines or tiles. Throws InputError.
std::unique_ptr<ImageFile> open_exr(const std::string& path, const std::string& layer = "");

/// The caller checks that all sizes match. `target` is the name that errors give to the file. Throws InputError.
void write_exr_file(const std::string& path, const std::string& target, const Rendering& rendering, ExrColour colour);

}  // namespace photonproof::inline scenes_images
