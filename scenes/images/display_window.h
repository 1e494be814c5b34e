// The image that a file means where it stores another part of it: EXR's display window and data window.
#pragma once

#include <memory>
#include <string>

#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {

/// The same image where both windows are one. Else the display window, as OpenImageIO's idiff and image viewers have
/// it: pixels of it that are not stored are black, what is stored outside of it is left out. Throws InputError when no
/// stored pixel lies in it.
std::unique_ptr<ImageFile> as_displayed(std::unique_ptr<ImageFile> file, const std::string& path);

}  // namespace photonproof::inline scenes_images
