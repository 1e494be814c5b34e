// What an EXR's attributes say of their own sizes, before OpenEXR allocates as much: up to 2 GiB each, for a file of
// any size (OpenEXR, "OpenEXR File Layout", section Header).
#pragma once

#include <string>

namespace photonproof::inline scenes_images {

/// Throws InputError where an attribute's size is negative or goes beyond the end of the file. Whatever else is wrong
/// with a header is OpenEXR's to say.
void check_attribute_sizes(const std::string& path);

}  // namespace photonproof::inline scenes_images
