#include "renderer/photon_map.h"

#include <cmath>

namespace photonproof {

PhotonMap::PhotonMap(const std::vector<Photon>& photons, float radius) {
  if (photons.empty()) return;
  Vec3f low = photons.front().p_world;
  Vec3f high = low;
  for (const Photon& photon : photons) {
    const Vec3f& p = photon.p_world;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  low_ = low;

  // Photons lie on surfaces: most cells of a fine grid are empty, so more of them than this only cost memory and time.
  const double most_cells = 8.0 * static_cast<double>(photons.size()) + 4096;
  const Vec3d extent = Vec3d(high) - Vec3d(low);
  const auto count = [](double length, double width) { return std::floor(length / width) + 1; };
  double width = radius;
  while (count(extent.x, width) * count(extent.y, width) * count(extent.z, width) > most_cells) width *= 1.25;
  cells_ = {static_cast<std::int64_t>(count(extent.x, width)), static_cast<std::int64_t>(count(extent.y, width)),
            static_cast<std::int64_t>(count(extent.z, width))};
  inverse_width_ = static_cast<float>(1 / width);

  std::vector<std::uint32_t> cell_of(photons.size());
  start_.assign(static_cast<std::size_t>(cells_.x * cells_.y * cells_.z) + 1, 0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    cell_of[i] = static_cast<std::uint32_t>(cell_index(clamped_cell(photons[i].p_world)));
    ++start_[cell_of[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];

  position_.resize(photons.size());
  flux_.resize(photons.size());
  surface_.resize(photons.size());
  edges_.resize(photons.size());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const std::size_t slot = next[cell_of[i]]++;
    position_[slot] = photons[i].p_world;
    flux_[slot] = photons[i].flux;
    surface_[slot] = photons[i].surface;
    edges_[slot] = photons[i].edges;
  }
}

}  // namespace photonproof
