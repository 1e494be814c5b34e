// Whether a PNG is whole: libpng prints a line of its own about one that is not, which no caller can keep from it.
#pragma once

#include <string>

namespace photonproof {

/// Throws InputError where a file that begins as a PNG is cut short or a chunk's checksum does not fit. Other files
/// pass.
void check_png(const std::string& path);

}  // namespace photonproof
