// Connects the film and the kernels, which estimate a tile's samples in separate slots.
#pragma once

#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/kernels/tasks.h"
#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/scene/scene_parts.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_passes {

inline constexpr Stream camera_stream{1}, extra_sample_stream{9}, shared_gather_stream{10};
/// The same for a filter's negative lobes.
inline constexpr Stream negative_camera_stream{24}, negative_extra_sample_stream{25}, negative_shared_gather_stream{26};

/// The filter's negative lobes, where samples are drawn from it.
NegativeLobes negative_lobes(const SceneParts& scene, const RenderJob& job);

/// Samples [first, first + samples) of a part of the filters of a tile's pixels.
CameraTask camera_task(const RenderJob& job, const Tile& tile, std::int64_t first, std::int64_t samples,
                       FilterPart part = FilterPart::positive);

/// Adds every sample to its pixel, in the order of the samples; `radiance` has 3 floats per path. The film has separate
/// negative lobes if the task is of these.
void add_samples(Film& film, const CameraTask& task, const std::vector<float>& radiance);

/// The same where a pixel's samples are one estimate, since they share photons or cache records.
void add_means(Film& film, const CameraTask& task, const std::vector<float>& radiance);

}  // namespace photonproof::inline renderer_passes
