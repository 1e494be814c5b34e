// The kernels of one instruction set. This file is compiled once for each (renderer/CMakeLists.txt), with
// PHOTONPROOF_KERNELS naming the table; PHOTONPROOF_SCALAR makes it the one-lane form, the definition of the others.
#include "renderer/kernels/path_kernel.h"
#include "renderer/kernels/photon_kernel.h"

namespace photonproof {

extern const Kernels PHOTONPROOF_KERNELS;

namespace {

#ifdef PHOTONPROOF_SCALAR
using Lanes = float;
#else
using Lanes = stdx::native_simd<float>;
#endif

void trace_paths(PathTask& task) { PathKernel<Lanes>(task).run(task.camera.paths()); }

void trace_photons(PhotonTask& task) {
  PhotonKernel<Lanes>(task).run(task.count);
  task.drain(task);
}

void gather_photons(const GatherTask& task) {
  for (std::size_t i = 0; i < task.count; ++i) {
    const std::uint32_t which = task.order[i];
    const GatherPoint& point = task.points[which];
    const PhotonFilter filter{point.surface, task.max_edges - static_cast<std::int32_t>(point.edges),
                              task.tests != nullptr ? task.tests[surface_number(point.surface)] : SheetTest::none,
                              point.sheet};
    task.flux[which] = gather(task.map, point.p, task.radius, filter);
  }
}

}  // namespace

const Kernels PHOTONPROOF_KERNELS{PHOTONPROOF_ISA,
                                  lane_count<Lanes>,
                                  PathKernel<Lanes>::scratch_words,
                                  PhotonKernel<Lanes>::scratch_words,
                                  trace_paths,
                                  trace_photons,
                                  gather_photons};

}  // namespace photonproof
