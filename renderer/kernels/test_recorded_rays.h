// The rays that the path tracer traces in a scene, recorded to be traced again alone: by Embree's single-ray queries,
// or by the kernels' packs.
#pragma once

#include <vector>

#include "renderer/rays/trace.h"
#include "renderer/scene/scene.h"

namespace photonproof::bench {

struct RecordedRays {
  std::vector<RayBlock> camera, bounce;  ///< unit directions
  std::vector<RayBlock> shadow;          ///< directions reach to the light
  std::size_t count(const std::vector<RayBlock>& blocks) const;
};

/// Rays of `samples` paths per pixel of at most max_depth edges, in the order in which a batch traces them.
RecordedRays record_rays(const Scene& scene, int samples, int max_depth);

}  // namespace photonproof::bench
