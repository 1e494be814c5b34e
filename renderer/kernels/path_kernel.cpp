#include "renderer/kernels/path_kernel.h"

#include "renderer/kernels/entries.h"

namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS {

static void trace_paths(PathTask& task) {
  PathKernel<Lanes>(task).run(task.bounces.count > 0 ? task.bounces.count : task.camera.paths());
}

const PathKernelEntry path{lane_count<Lanes>, PathKernel<Lanes>::scratch_words, trace_paths};

}  // namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS
