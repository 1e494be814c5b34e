#include "renderer/kernels/photon_kernel.h"

#include "renderer/kernels/entries.h"

namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS {

static void trace_photons(PhotonTask& task) {
  PhotonKernel<Lanes>(task).run(task.count);
  task.drain(task);
}

const PhotonKernelEntry photon{PhotonKernel<Lanes>::scratch_words, trace_photons};

}  // namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS
