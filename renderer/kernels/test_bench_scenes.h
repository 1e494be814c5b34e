// Scenes for the benches, compiled once per process.
#pragma once

#include <memory>
#include <string>

#include "renderer/scene/scene.h"

namespace photonproof::bench {

/// A scene of the library, or "million:N", generated with N triangles. `embree` switches the packed kernel off.
const Scene& scene(const std::string& name, bool embree);

/// Count parallelograms of random place and orientation in a cube, for the threshold between kernel and Embree.
std::unique_ptr<Scene> random_plates(int count, bool embree);

}  // namespace photonproof::bench
