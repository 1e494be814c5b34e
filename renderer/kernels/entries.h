// Tables of a kernel source for the instruction set it is compiled for, in a namespace named by PHOTONPROOF_KERNELS
// (renderer/CMakeLists.txt). PHOTONPROOF_SCALAR makes it the one-lane form, the definition of the others.
#pragma once

#include "renderer/kernels/tasks.h"
#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS {

#ifdef PHOTONPROOF_SCALAR
using Lanes = float;
#else
using Lanes = stdx::native_simd<float>;
#endif

extern const PathKernelEntry path;
extern const PhotonKernelEntry photon;
extern const GatherKernelEntry gather;

}  // namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS
