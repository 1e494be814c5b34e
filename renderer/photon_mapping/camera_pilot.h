// Pilot camera samples, which contribute to no image. They find pixels where ordinary samples would rarely meet a light
// by mirrors or through glass, before one of these outshines the image. In the pilot smooth glass reflects as often as
// it refracts (light_search.h). Light after reflections inside glass is thus found a hundred times as soon. The pilot's
// variance only chooses a pixel's number of samples (adaptive_sample_map.h), which causes no bias.
#pragma once

#include <cstdint>

#include "renderer/core/parallel.h"
#include "renderer/kernels/tasks.h"
#include "renderer/passes/render_job.h"
#include "renderer/photon_mapping/adaptive_sample_map.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_photon_mapping {

/// Passes the variance of the window's pixels to `effort`. First samples some rows. Pixels near those that see
/// something by mirrors or through glass then get more samples, the more the fewer such pixels there are.
void run_camera_pilot(const Scene& scene, const PathSettings& settings, const RenderJob& job, const Threads& threads,
                      const Tile& window, AdaptiveSampleMap& effort, RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
