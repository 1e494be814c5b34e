// Adds the light of photons to the points of a gather queue.

#include "renderer/kernels/entries.h"
#include "renderer/photons/photon_gather.h"
#include "renderer/scene/surface_detail.h"

namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS {

static void gather_photons(const GatherTask& task) {
  const GatherPoints& points = task.points;
  for (std::size_t k = 0; k < points.count; ++k) {
    const std::uint32_t i = task.order[k];
    const PhotonFilter filter{points.surface[i], task.max_edges - static_cast<std::int32_t>(points.edges[i]),
                              task.tests != nullptr ? task.tests[surface_number(points.surface[i])] : SheetTest::none,
                              points.surface_side[i]};
    const GatheredFlux gathered =
        photonproof::gather(task.map, {points.x[i], points.y[i], points.z[i]}, points.radius[i], filter);
    points.flux_red[i] = gathered.flux.x;
    points.flux_green[i] = gathered.flux.y;
    points.flux_blue[i] = gathered.flux.z;
    points.found[i] = static_cast<std::uint32_t>(gathered.count);
  }
}

static void add_gathered(const GatherPoints& points, float* radiance) {
  for (std::size_t i = 0; i < points.count; ++i) {
    if (!(points.area[i] > 0)) continue;
    float* out = radiance + 3 * std::size_t{points.path[i]};
    out[0] += points.weight_red[i] * points.flux_red[i] / points.area[i];
    out[1] += points.weight_green[i] * points.flux_green[i] / points.area[i];
    out[2] += points.weight_blue[i] * points.flux_blue[i] / points.area[i];
  }
}

const GatherKernelEntry gather{gather_photons, add_gathered};

}  // namespace photonproof::inline renderer_kernels::PHOTONPROOF_KERNELS
