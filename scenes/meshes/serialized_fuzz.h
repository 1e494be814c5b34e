// The check of the fuzzer of serialized meshes.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Reads mesh 0 and mesh 1. Empty when each gives a mesh that keeps the promises of mesh.h, or one good error.
std::string check_serialized(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes
