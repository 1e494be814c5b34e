#include "renderer/photon_mapping/shared_gathers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "renderer/lanes/sampler.h"
#include "renderer/photons/surface_side.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr int largest_block = 8;
constexpr double radius_in_blocks = 3;

/// The points' numbers sorted by pixel, within a pixel by path, and within a path in the order of creation (counting
/// sorts).
struct PointsByPixel {
  std::vector<std::uint32_t> begin;  ///< start of each pixel, and one past the last
  std::vector<std::uint32_t> order;

  PointsByPixel(const GatherPoints& points, const std::vector<std::uint32_t>& pixel_of) {
    std::vector<std::uint32_t> begin_of_path(pixel_of.size() + 1, 0);
    begin.assign(pixel_of.empty() ? 1 : *std::ranges::max_element(pixel_of) + 2, 0);
    for (std::size_t i = 0; i < points.count; ++i) {
      ++begin_of_path[points.path[i] + 1];
      ++begin[pixel_of[points.path[i]] + 1];
    }
    std::partial_sum(begin_of_path.begin(), begin_of_path.end(), begin_of_path.begin());
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint32_t> by_path(points.count), slot(begin_of_path);
    for (std::uint32_t i = 0; i < points.count; ++i) by_path[slot[points.path[i]]++] = i;
    slot = begin;
    order.resize(points.count);
    for (const std::uint32_t i : by_path) order[slot[pixel_of[points.path[i]]]++] = i;
  }
};

float size_of(const Rgb& weight) { return std::max({weight.x, weight.y, weight.z}); }

/// Side and rough direction of the normal: the three highest bits of its two coordinates.
std::uint32_t side_of(std::uint32_t surface_side) {
  return surface_side & (SurfaceSide::from_behind | 0b1110000000'1110000000u);
}

bool end_alike(const GatherPoint& a, const GatherPoint& b) {
  return a.surface == b.surface && a.edges == b.edges && side_of(a.surface_side) == side_of(b.surface_side);
}

bool are_within(float distance, const Vec3f& a, const Vec3f& b) { return length_squared(a - b) <= distance * distance; }

}  // namespace

std::vector<PixelPoint> points_of_pixels(GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of,
                                         float most_apart, std::uint32_t key) {
  const GatherPoints points = queue.view();
  const PointsByPixel by_pixel(points, pixel_of);
  std::vector<PixelPoint> found;
  found.reserve(by_pixel.begin.size() * 2);
  for (std::size_t pixel = 0; pixel + 1 < by_pixel.begin.size(); ++pixel) {
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    for (std::uint32_t k = by_pixel.begin[pixel]; k < by_pixel.begin[pixel + 1]; ++k) {
      const GatherPoint point = queue[by_pixel.order[k]];
      const float size = size_of(point.weight);
      const auto alike = std::find_if(found.begin() + first, found.end(), [&](const PixelPoint& other) {
        return end_alike(other.point, point) && are_within(most_apart, other.point.p, point.p);
      });
      if (alike == found.end()) {
        found.push_back({static_cast<std::uint32_t>(pixel), point, size});
        continue;
      }
      alike->size += size;
      if (draw_independent<float>(key, point.path, 0u) * alike->size < size) alike->point = point;
    }
    for (auto p = found.begin() + first; p != found.end(); ++p) p->point.weight *= p->size / size_of(p->point.weight);
  }
  return found;
}

std::vector<PixelPoint> points_by_themselves(const GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of) {
  std::vector<PixelPoint> points(queue.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const GatherPoint point = queue[i];
    points[i] = {pixel_of[point.path], point, size_of(point.weight)};
  }
  return points;
}

BlockGrid block_grid(double pixels_a_radius, std::uint32_t key) {
  const double wanted = std::clamp(pixels_a_radius / radius_in_blocks, 1.0, double{largest_block});
  const auto size = std::bit_floor(static_cast<std::uint32_t>(wanted));
  const std::uint32_t bits = mix_bits(key);
  return {static_cast<int>(size), static_cast<int>(bits % size), static_cast<int>(bits / size % size)};
}

SharedGathers::SharedGathers(const std::vector<PixelPoint>& points, const std::vector<float>& radius, const Tile& tile,
                             const BlockGrid& grid, std::uint32_t key) {
  gather_of.resize(points.size());
  queue.reserve(points.size());
  if (grid.size == 1) {
    for (const PixelPoint& p : points) queue.push_back(p.point);
    std::ranges::copy(radius, queue.view().radius);
    std::iota(gather_of.begin(), gather_of.end(), 0u);
    return;
  }
  struct Group {
    std::uint32_t next;   ///< next group of the block; `none` ends the list
    std::uint32_t drawn;  ///< number of the chosen point in `points`
    float size;
    Vec3f p;  ///< position of its first point
    float radius;
  };
  constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<Group> groups;
  const int across = (tile.width() - 1 + grid.size - 1) / grid.size + 1;
  const int down = (tile.height() - 1 + grid.size - 1) / grid.size + 1;
  std::vector<std::uint32_t> first(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), none);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const PixelPoint& p = points[i];
    const int x = static_cast<int>(p.pixel) % tile.width(), y = static_cast<int>(p.pixel) / tile.width();
    const auto block = static_cast<std::size_t>((y + grid.y) / grid.size) * static_cast<std::size_t>(across) +
                       static_cast<std::size_t>((x + grid.x) / grid.size);
    std::uint32_t g = first[block];
    while (g != none && !(end_alike(points[groups[g].drawn].point, p.point) &&
                          are_within(0.5f * std::min(radius[i], groups[g].radius), groups[g].p, p.point.p)))
      g = groups[g].next;
    if (g == none) {
      g = static_cast<std::uint32_t>(groups.size());
      groups.push_back({first[block], i, p.size, p.point.p, radius[i]});
      first[block] = g;
    } else {
      groups[g].size += p.size;
      if (draw_independent<float>(key, p.point.path, 1u) * groups[g].size < p.size) groups[g].drawn = i;
    }
    gather_of[i] = g;
  }
  for (const Group& group : groups) queue.push_back(points[group.drawn].point);
  const GatherPoints looked_up = queue.view();
  for (std::size_t g = 0; g < groups.size(); ++g) looked_up.radius[g] = radius[groups[g].drawn];
}

}  // namespace photonproof::inline renderer_photon_mapping
