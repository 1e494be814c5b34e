#include "renderer/kernels/path_kernel.h"

#include "renderer/kernels/entries.h"

namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS {

static void trace_paths(PathTask& task) {
  with_policy(task.policy, [&]<class Policy>(Policy) { trace_by_policy<Policy, Lanes>(task); });
}

const PathKernelEntry path{lane_count<Lanes>, PathSteps<Lanes>::scratch_words, trace_paths};

}  // namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS
