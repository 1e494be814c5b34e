// A heightfield as the mesh that rays meet in its place.
#pragma once

#include "renderer/textures/texture.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_shapes {

/// In the shape's local space: columns x rows cells of two triangles over [-1,1]^2, facing +z, uv over the square.
/// Noise is scaled so that the sum of its octaves stays within the amplitude.
TriangleMesh make_heightfield(const HeightfieldDescription& description, const Textures& textures);

}  // namespace photonproof::inline renderer_shapes
