// Turns the description's emitters and emitting shapes into lights.
#pragma once

#include <functional>

#include "renderer/lights/light.h"
#include "renderer/shapes/scene_ball.h"
#include "renderer/shapes/surface.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_lights {

/// Gives the function of uv that a texture of the description stands for.
using TextureLookup = std::function<LightTexture(TextureIndex)>;

/// The light of an emitting shape's surface. `to_world` is the shape's, moved to the scene's origin. Throws InputError
/// at `where` for shapes that cannot emit, or where the flux exceeds single precision.
Light compile_surface_light(const Surface& surface, const ShapeDescription& shape, const Transform& to_world,
                            const TextureLookup& texture, const std::string& where);

/// `moved` is added to the description's coordinates. Throws InputError at `where`.
Light compile_light(const EmitterDescription& emitter, const Vec3d& moved, const SceneBall& ball,
                    const TextureLookup& texture, const std::string& where);

}  // namespace photonproof::inline renderer_lights
