// Channel A of an image: the share of a pixel's camera rays that end on a shape. What Mitsuba's film calls alpha,
// except that the environment never counts, visible or hidden.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/passes/render_job.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_scalar {

/// For the window's pixels, row by row, in [0,1]; of as many camera samples as the image has a pixel, at most
/// `most_coverage_samples`. Rays pass what lets light go straight on (null, the holes of a mask, a pane's transmission)
/// and, where `hide_emitters` is true, lights. Media do not count. The same bits for any number of threads.
std::vector<float> coverage(const Scene& scene, const RenderJob& job, bool hide_emitters, const Tile& window,
                            std::int64_t samples);
inline constexpr std::int64_t most_coverage_samples = 1024;

}  // namespace photonproof::inline renderer_scalar
