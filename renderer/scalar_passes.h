// The frame around scalar integrators: passes over the image, tiles or chunks of paths to threads, sums to the film.
#pragma once

#include <functional>

#include "renderer/draws.h"
#include "renderer/integrator.h"
#include "renderer/splats.h"

namespace photonproof {

/// What one thread's histories count and collect.
struct ScalarWork {
  RayCounts rays;
  Splats splats;
};

/// Radiance of one camera sample through pixel (x, y); `draws` are the sample's own.
using PixelEstimate = std::function<Rgb(int x, int y, const Draws& draws, ScalarWork& work)>;

/// Renders with one camera sample after the other. Samples are independent estimates, and so the film's variances
/// honest. For estimators without splats.
void render_samples(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                    RenderStats& stats, const PixelEstimate& estimate);

/// Renders with as many histories as camera samples, each of which may give its pixel radiance and splat anywhere. What
/// a pixel gets in one pass is one estimate: splats of one pass share their paths, passes share nothing, so that the
/// spread between passes is an honest variance.
///
/// `make_estimate` is called for every tile; what it makes may own scratch memory.
void render_splats(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                   RenderStats& stats, const std::function<PixelEstimate()>& make_estimate);

}  // namespace photonproof
