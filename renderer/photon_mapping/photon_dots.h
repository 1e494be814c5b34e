// The view `photons`: where photons landed. Every stored photon that the camera sees is joined to it as a vertex of
// light tracing is, and adds a dot of its flux to the one pixel it is seen in. Dots are scaled so that the pass's mean
// photon has the brightness 1, and divided by the pass's samples of a pixel, with which photons are emitted. So the
// image's sum is how many photons the camera sees for each sample, in which bright ones count for more. Neither what
// the surface reflects nor its distance is in a dot.
#pragma once

#include "renderer/passes/render_loop.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_photon_mapping {

/// `maps` have no radii. The passes are those of the whole image, with the same photons.
void render_photon_dots(const PhotonSource& source, PhotonMaps& maps, const PassPlan& passes, Film& film,
                        RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
