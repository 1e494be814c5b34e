// The guarantees of the reader of ellipsoids, for its tests and its fuzzer.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_ellipsoids {

/// Empty when the bytes give a cloud that keeps the promises of ellipsoid_cloud.h, or one good error.
std::string check_ellipsoids(std::string_view bytes);

}  // namespace photonproof::inline scenes_ellipsoids
