// Camera samples beforehand, which are in no image: they find the pixels where ordinary samples would rarely meet a
// light by mirrors or through glass, before one of them does and outshines the image. Smooth glass reflects as often as
// it refracts in them (light_search.h), so that what a camera path finds after reflections inside is found a hundred
// times as soon. By their variance a pixel's number of samples is chosen (adaptive_sample_map.h), which biases nothing.
#pragma once

#include <cstdint>

#include "renderer/core/parallel.h"
#include "renderer/kernels/tasks.h"
#include "renderer/passes/render_job.h"
#include "renderer/photon_mapping/adaptive_sample_map.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_photon_mapping {

/// Tells `effort` about the window's pixels. Some rows are looked at first; pixels near those that see something by
/// mirrors or through glass then get more samples, the more of them the fewer pixels they are.
void run_camera_pilot(const Scene& scene, const PathSettings& settings, const RenderJob& job, const Threads& threads,
                      const Tile& window, AdaptiveSampleMap& effort, RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
