// A path's way through a medium up to its next scattering.
#pragma once

#include <optional>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_media {

/// A path's distance to its next scattering, if that comes before the next surface.
struct FreeFlight {
  std::optional<float> scattered;  ///< where
  Rgb weight;                      ///< transmittance, and albedo x extinction where it scattered, over the density
};

}  // namespace photonproof::inline renderer_media
