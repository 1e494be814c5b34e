// A heightfield as a triangle mesh. It follows docs/formats/scene.md, not the renderer's code, for which it is an
// independent reference.
#pragma once

#include <memory>
#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline reference_engines {

/// columns x rows cells over [-1,1]^2 of the shape's local xy plane, each cut from (0,0) to (1,1), facing +z. Throws
/// NotRepresentable, with the engine's name, for heights that are not a plain bitmap.
std::shared_ptr<const TriangleMesh> heightfield_mesh(const SceneDescription& scene, const HeightfieldDescription& field,
                                                     const std::string& engine);

}  // namespace photonproof::inline reference_engines
