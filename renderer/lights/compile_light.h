// Turns the description's emitters and emitting shapes into lights.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "renderer/lights/light.h"
#include "renderer/shapes/scene_ball.h"
#include "renderer/shapes/surface.h"
#include "renderer/textures/texture.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_lights {

/// Gives lights the textures of the description. The functions share ownership of them.
class TextureLookup {
 public:
  explicit TextureLookup(std::shared_ptr<const Textures> textures) : textures_(std::move(textures)) {}
  /// Throws InputError at `where` for mesh attributes, which are no function of uv.
  LightTexture operator()(TextureIndex texture, const std::string& where) const;
  Vec2<int> resolution(TextureIndex texture) const { return textures_->resolution(texture.value); }

 private:
  std::shared_ptr<const Textures> textures_;
};

/// The light of an emitting shape's surface. `to_world` is the shape's, moved to the scene's origin. Throws InputError
/// at `where` for shapes that cannot emit, or where the flux exceeds single precision.
Light compile_surface_light(const Surface& surface, const ShapeDescription& shape, const Transform& to_world,
                            const TextureLookup& texture, const std::string& where);

/// `moved` is added to the description's coordinates. Throws InputError at `where`.
Light compile_light(const EmitterDescription& emitter, const Vec3d& moved, const SceneBall& ball,
                    const TextureLookup& texture, const std::string& where);

}  // namespace photonproof::inline renderer_lights
