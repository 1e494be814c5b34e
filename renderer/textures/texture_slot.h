// The place of a texture's value in the record of a BSDF.
#pragma once

#include <cstdint>

namespace photonproof::inline renderer_textures {

struct TextureSlot {
  std::uint32_t texture;  ///< index in SceneDescription::textures
  std::uint32_t word;     ///< of the record; a colour's channels follow each other
  bool is_colour;         ///< else the colour's number goes there (Textures::number)
  friend bool operator==(const TextureSlot&, const TextureSlot&) = default;
};

}  // namespace photonproof::inline renderer_textures
