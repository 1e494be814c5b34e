// Albedo and normals of the first surfaces that camera rays meet and that are no mirrors, as guides for a denoiser.
// Rays continue behind mirrors and clear glass, whose colour multiplies the albedo.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "renderer/core/parallel.h"
#include "renderer/passes/render_job.h"
#include "renderer/scene/scene.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_denoising {

/// Means over camera samples, for the window's pixels.
struct Guides {
  Image albedo;  ///< Directional albedo in [0,1], by one sample of the BSDF each. No surface gives 0.
  Image normal;  ///< Shading normals of world space, turned to the viewer. No surface gives 0.
};

/// Takes `samples` camera samples a pixel, by the film's filter without its negative lobes. Rays pass surfaces that let
/// light go straight on and, with `hide_emitters`, lights; media do not count. Reports progress by `job`. Empty after
/// an interrupt. The same bits for any number of threads.
std::optional<Guides> trace_guides(const Scene& scene, const RenderJob& job, bool hide_emitters, const Tile& window,
                                   int samples);

}  // namespace photonproof::inline renderer_denoising
