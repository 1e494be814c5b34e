// The frame around scalar integrators: their units of work in a RenderLoop, and their sums in the film.
#pragma once

#include <functional>

#include "renderer/core/ray_counts.h"
#include "renderer/lanes/path_sampler.h"
#include "renderer/passes/render_loop.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/splats.h"

namespace photonproof::inline renderer_scalar {

/// Ray counts and splats of one unit of work.
struct ScalarWork {
  RayCounts rays;
  Splats splats;
  FilterPart part = FilterPart::positive;  ///< Part of the filter from which camera rays are drawn.
};

/// Radiance of one camera sample of pixel (x, y); `draws` is the sample's own sampler. Splats of samples of the
/// filter's negative part do not count.
using PixelEstimate = std::function<Rgb(int x, int y, const PathSampler& draws, ScalarWork& work)>;

/// Renders one camera sample after the other. Samples are independent estimates, so the film's variances are unbiased.
/// For estimators without splats.
void render_samples(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                    RenderStats& stats, const PixelEstimate& estimate);

/// Renders with as many paths as camera samples, each of which may add radiance to its pixel and splat anywhere. The
/// sum of a pixel in one pass is one estimate for the film. Splats of one pass share their paths and passes share
/// nothing, so the spread between passes is an unbiased variance. (The Sobol sampler stratifies passes against each
/// other; their variance is then an upper bound.) There are about `passes_wanted` passes where the budget fixes the
/// number of samples. `make_estimate` is called for every tile; its result may own scratch memory.
void render_splats(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                   RenderStats& stats, const std::function<PixelEstimate()>& make_estimate);

}  // namespace photonproof::inline renderer_scalar
