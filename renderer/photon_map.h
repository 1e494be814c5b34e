// Photons in a counting-sorted uniform grid, structure of arrays; immutable once built.
// The layout follows the usual fixed-radius hash grid (Georgiev's SmallVCM explains one), with the cells of a row along
// x adjacent, so that a query reads a few contiguous ranges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scenes/vec.h"

namespace photonproof {

struct Photon {
  Vec3f p_world;
  Rgb flux;                   ///< W
  std::uint32_t surface = 0;  ///< where it landed: index into Scene::surfaces
  std::int32_t edges = 0;     ///< path edges from the light to here
};

class PhotonMap {
 public:
  PhotonMap() = default;
  /// Cells are `radius` wide, wider where the grid would outgrow the photons; queries may use any radius. Photons keep
  /// their order within a cell, so that sums do not depend on how they were gathered.
  PhotonMap(const std::vector<Photon>& photons, float radius);

  std::size_t size() const { return flux_.size(); }
  bool empty() const { return flux_.empty(); }

  const Vec3f& position(std::size_t i) const { return position_[i]; }
  const Rgb& flux(std::size_t i) const { return flux_[i]; }
  std::uint32_t surface(std::size_t i) const { return surface_[i]; }
  std::int32_t edges(std::size_t i) const { return edges_[i]; }

  /// Calls visit(i) for every photon with |position - p| <= radius, in a fixed order.
  template <class Visit>
  void for_each_within(const Vec3f& p, float radius, Visit&& visit) const {
    if (empty()) return;
    const Cell low = clamped_cell(p - Vec3f(radius));
    const Cell high = clamped_cell(p + Vec3f(radius));
    const float radius2 = radius * radius;
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        const std::size_t begin = start_[cell_index({low.x, y, z})];
        const std::size_t end = start_[cell_index({high.x, y, z}) + 1];
        for (std::size_t i = begin; i < end; ++i)
          if (length_squared(position_[i] - p) <= radius2) visit(i);
      }
    }
  }

 private:
  using Cell = Vec3<std::int64_t>;
  Cell clamped_cell(const Vec3f& p) const {
    const auto along = [](float x, float low, float inverse, std::int64_t count) {
      const float cell = std::clamp((x - low) * inverse, 0.0f, static_cast<float>(count - 1));
      return static_cast<std::int64_t>(cell);
    };
    return {along(p.x, low_.x, inverse_width_, cells_.x), along(p.y, low_.y, inverse_width_, cells_.y),
            along(p.z, low_.z, inverse_width_, cells_.z)};
  }
  std::size_t cell_index(const Cell& c) const {
    return static_cast<std::size_t>((c.z * cells_.y + c.y) * cells_.x + c.x);
  }

  Vec3f low_;
  float inverse_width_ = 1;
  Cell cells_{1, 1, 1};
  std::vector<std::uint32_t> start_;  ///< first photon of each cell, and one past the last
  std::vector<Vec3f> position_;
  std::vector<Rgb> flux_;
  std::vector<std::uint32_t> surface_;
  std::vector<std::int32_t> edges_;
};

}  // namespace photonproof
