#include "renderer/photon_mapping/photon_radius.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <vector>

#include "renderer/scene/looked_at.h"
#include "renderer/sensor/camera.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Positions of the photons of each surface, in the photons' order.
class PhotonsBySurface {
 public:
  explicit PhotonsBySurface(const Photons& photons) : photons_(photons) {
    for (std::size_t i = 0; i < photons.size(); ++i) positions_[photons.surface[i]].push_back(photons[i].p_world);
  }

  /// Distance from photon i to its k-th nearest photon on the same surface; negative where there are too few.
  float distance_to_neighbour(std::size_t i, std::size_t k) const {
    const Vec3f p = photons_[i].p_world;
    const std::vector<Vec3f>& others = positions_.at(photons_.surface[i]);
    if (others.size() <= k) return -1;
    std::vector<float> squares(others.size());
    std::ranges::transform(others, squares.begin(), [&](const Vec3f& other) { return length_squared(other - p); });
    const auto kth = squares.begin() + static_cast<std::ptrdiff_t>(k);
    std::nth_element(squares.begin(), kth, squares.end());  // [0] is the photon itself
    return std::sqrt(*kth);
  }

 private:
  const Photons& photons_;
  std::map<std::uint32_t, std::vector<Vec3f>> positions_;
};

}  // namespace

float median_pixel_footprint(const Scene& scene) {
  std::vector<float> footprints;
  for (const Vec3f& p : points_looked_at(scene, 16)) footprints.push_back(pixel_footprint(scene.view().camera, p));
  return footprints.empty() ? 0 : median(footprints);
}

double photons_around_one(const Photons& photons, float radius, const Threads& threads) {
  constexpr std::size_t most_probes = 64, most_pairs = 100'000'000;
  const std::size_t count = photons.size();
  if (count == 0) return 0;
  const std::size_t probes = std::clamp<std::size_t>(most_pairs / count, 1, std::min(most_probes, count));
  std::vector<double> around(probes);
  threads.for_each(probes, [&](std::size_t probe) {
    const std::size_t i = probe * (count / probes);
    const Vec3f p = photons[i].p_world;
    const auto is_near = [&](std::size_t k) {
      const Vec3f to{photons.x[k] - p.x, photons.y[k] - p.y, photons.z[k] - p.z};
      return photons.surface[k] == photons.surface[i] && length_squared(to) <= radius * radius;
    };
    for (std::size_t k = 0; k < count; ++k) around[probe] += k != i && is_near(k) ? 1 : 0;
  });
  return std::accumulate(around.begin(), around.end(), 0.0) / static_cast<double>(probes);
}

float guess_radius(const Scene& scene, const Photons& photons, double emitted, double total, double photons_in_disc,
                   const Threads& threads) {
  constexpr std::size_t probes = 64;
  constexpr std::size_t neighbour = 16;  // the distance to this neighbour measures the density around a probe
  if (photons.size() <= neighbour) return 0;

  const PhotonsBySurface by_surface(photons);
  const std::size_t stride = std::max<std::size_t>(1, photons.size() / probes);
  std::vector<float> distances((photons.size() + stride - 1) / stride);
  threads.for_each(distances.size(),
                   [&](std::size_t i) { distances[i] = by_surface.distance_to_neighbour(i * stride, neighbour); });
  std::erase_if(distances, [](float distance) { return distance < 0; });
  if (distances.empty()) return 0;
  const double scale = photons_in_disc / static_cast<double>(neighbour) * emitted / total;
  const auto radius = static_cast<float>(median(distances) * std::sqrt(scale));
  const float footprint = median_pixel_footprint(scene);
  return footprint > 0 ? std::clamp(radius, 0.35f * footprint, 20 * footprint) : radius;
}

}  // namespace photonproof::inline renderer_photon_mapping
