// Guesses the gather radius of a photon map from a small pilot run.
#pragma once

#include "renderer/photon_mapping/photon_tracing.h"

namespace photonproof::inline renderer_photon_mapping {

/// The radius whose disc holds `photons_in_disc` photons at the median photon of a run of `total` emitted paths, kept
/// between 0.35 and 20 pixel footprints. 0 when the pilot stores nothing to measure.
float guess_radius(const Scene& scene, PhotonRun pilot, std::uint64_t total, double photons_in_disc,
                   const PhotonMethod& method, const Threads& threads, RayTotals& totals);

/// Others of its surface within `radius` of a photon, on average over a sample of them; 0 where there are none.
double photons_around_one(const Photons& photons, float radius, const Threads& threads);

/// World size of a pixel at the median first hit of a lattice of camera rays; 0 when nothing is hit.
float median_pixel_footprint(const Scene& scene);

}  // namespace photonproof::inline renderer_photon_mapping
