#include "renderer/passes/photon_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/looked_at.h"
#include "renderer/sensor/camera.h"

namespace photonproof {
namespace {

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

float median_pixel_footprint(const Scene& scene) {
  std::vector<float> footprints;
  for (const Vec3f& p : points_looked_at(scene, 16)) footprints.push_back(pixel_footprint(scene.view().camera, p));
  return footprints.empty() ? 0 : median(footprints);
}

float choose_radius(const Scene& scene, PhotonRun pilot, std::uint64_t total, double photons_in_disc,
                    const PhotonMethod& method, const Threads& threads, RayTotals& totals) {
  constexpr std::size_t probes = 256;
  constexpr std::size_t neighbour = 16;  // its distance measures the density around a probe
  pilot.stream = pilot_stream;
  const Photons photons = trace_photons(scene, pilot, method, threads, totals);
  if (photons.size() <= neighbour) return 0;

  std::vector<float> distances;
  std::vector<float> to_others;
  const std::size_t stride = std::max<std::size_t>(1, photons.size() / probes);
  for (std::size_t i = 0; i < photons.size(); i += stride) {
    to_others.clear();
    for (std::size_t j = 0; j < photons.size(); ++j)
      if (photons.surface[j] == photons.surface[i])
        to_others.push_back(length_squared(photons[j].p_world - photons[i].p_world));
    if (to_others.size() <= neighbour) continue;
    std::nth_element(to_others.begin(), to_others.begin() + neighbour, to_others.end());  // [0] is the probe itself
    distances.push_back(std::sqrt(to_others[neighbour]));
  }
  if (distances.empty()) return 0;
  const double scale =
      photons_in_disc / static_cast<double>(neighbour) * static_cast<double>(pilot.count) / static_cast<double>(total);
  const auto radius = static_cast<float>(median(distances) * std::sqrt(scale));
  const float footprint = median_pixel_footprint(scene);
  return footprint > 0 ? std::clamp(radius, 1.5f * footprint, 20 * footprint) : radius;
}

}  // namespace photonproof
