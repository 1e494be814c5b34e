// Guesses the gather radius of a photon map from a small pilot run.
#pragma once

#include "renderer/photon_mapping/photon_tracing.h"

namespace photonproof::inline renderer_photon_mapping {

/// The gather radius whose disc holds `photons_in_disc` photons at the median photon of `total` paths, by the photons
/// of a pilot of `emitted` paths. It is kept between 0.35 and 20 pixel footprints, and is 0 when the pilot stored too
/// few photons to measure.
float guess_radius(const Scene& scene, const Photons& photons, double emitted, double total, double photons_in_disc,
                   const Threads& threads);

/// Mean number of other photons of the same surface within `radius` of a photon, over a sample of photons; 0 without
/// any.
double photons_around_one(const Photons& photons, float radius, const Threads& threads);

/// World size of a pixel at the median first hit of a lattice of camera rays; 0 when nothing is hit.
float median_pixel_footprint(const Scene& scene);

}  // namespace photonproof::inline renderer_photon_mapping
