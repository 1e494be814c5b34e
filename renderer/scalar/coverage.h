// Channel A of an image: the share of a pixel's camera rays that end on a shape. Mitsuba's film calls this alpha; here
// the environment never counts, visible or hidden.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/passes/render_job.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_scalar {

/// Values in [0,1], or around it where the filter has negative lobes, for the window's pixels, row by row. Each takes
/// as many camera samples as the image has per pixel, at most `most_coverage_samples`. Rays pass surfaces that let
/// light go straight on (null, the holes of a mask, a pane's transmission) and, with `hide_emitters`, lights. Media do
/// not count. The same bits for any number of threads.
std::vector<float> coverage(const Scene& scene, const RenderJob& job, bool hide_emitters, const Tile& window,
                            std::int64_t samples);
inline constexpr std::int64_t most_coverage_samples = 1024;

}  // namespace photonproof::inline renderer_scalar
