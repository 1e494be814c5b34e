// The frame around scalar integrators: their units of work in a RenderLoop, their sums to the film.
#pragma once

#include <functional>

#include "renderer/core/ray_counts.h"
#include "renderer/lanes/path_sampler.h"
#include "renderer/passes/render_loop.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/splats.h"

namespace photonproof::inline renderer_scalar {

/// What the paths of one unit of work count and collect.
struct ScalarWork {
  RayCounts rays;
  Splats splats;
};

/// Radiance of one camera sample of pixel (x, y); `draws` are the sample's own.
using PixelEstimate = std::function<Rgb(int x, int y, const PathSampler& draws, ScalarWork& work)>;

/// Renders with one camera sample after the other. Samples are independent estimates, and so the film's variances
/// honest. For estimators without splats.
void render_samples(const RenderJob& job, Stream stream, const char* phase, Film& film, RenderStats& stats,
                    const PixelEstimate& estimate);

/// Renders with as many paths as camera samples, each of which may give its pixel radiance and splat anywhere. What
/// a pixel gets in one pass is one estimate of the film's: splats of one pass share their paths, passes share nothing,
/// so that the spread between passes is an honest variance. (Passes of the Sobol sampler are stratified against each
/// other, and their variance then is an upper bound.) There are about `passes_wanted` passes where the budget says how
/// many samples there will be. `make_estimate` is called for every tile; what it makes may own scratch memory.
void render_splats(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                   RenderStats& stats, const std::function<PixelEstimate()>& make_estimate);

}  // namespace photonproof::inline renderer_scalar
