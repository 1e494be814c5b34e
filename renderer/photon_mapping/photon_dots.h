// The view `photons`: landing points of photons. Every stored photon that the camera sees is connected to it, like a
// vertex of light tracing. It adds a dot of its flux to the one pixel that it is seen in. Dots are scaled so that the
// pass's mean photon has the brightness 1, and divided by the pass's samples of a pixel, with which photons are
// emitted. The image's sum is thus the number of visible photons for each sample, weighted by brightness. Reflectance
// and distance do not affect a dot.
#pragma once

#include "renderer/passes/render_loop.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_photon_mapping {

/// The `maps` have no radii. The passes are those of the whole image, with the same photons.
void render_photon_dots(const PhotonSource& source, PhotonMaps& maps, const PassPlan& passes, Film& film,
                        RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
