// The full image of a file that stores another part of it: EXR's display window and data window.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {

/// The same image where both windows are equal. Else the display window, as in OpenImageIO's idiff and image viewers:
/// its pixels that are not stored are black, and stored pixels outside it are left out. Throws InputError when no
/// stored pixel lies in it.
std::unique_ptr<ImageFile> as_displayed(std::unique_ptr<ImageFile> file, const std::string& path);

}  // namespace photonproof::inline scenes_images
