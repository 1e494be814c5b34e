// Textures as lights use them: a function of uv.
#pragma once

#include <functional>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_textures {

/// Linear Rec.709 colour at uv.
using LightTexture = std::function<Rgb(const Vec2<float>& uv)>;

}  // namespace photonproof::inline renderer_textures
