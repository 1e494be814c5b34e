// How messages, keys and file names write the size of an image.
#pragma once

#include <string>

namespace photonproof::inline scenes_base {

/// "64x48"
inline std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace photonproof::inline scenes_base
