// The check of the fuzzer of volume files.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Empty when the bytes give a grid that keeps the promises of vol.h, or one good error.
std::string check_vol(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes
