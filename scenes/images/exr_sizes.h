// Checks the sizes that an EXR's attributes declare. OpenEXR allocates as much: up to 2 GiB each, for a file of any
// size (OpenEXR, "OpenEXR File Layout", section Header).
#pragma once

#include <string>

namespace photonproof::inline scenes_images {

/// Throws InputError where an attribute's size is negative or goes beyond the end of the file. OpenEXR reports other
/// errors in a header.
void check_attribute_sizes(const std::string& path);

}  // namespace photonproof::inline scenes_images
