#include "renderer/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/core/ray.h"

namespace photonproof::inline renderer_lights {
namespace {

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

float middle(const LightBounds& bounds, int axis) {
  return 0.5f * (component(bounds.low, axis) + component(bounds.high, axis));
}

/// Solid angle of the lit directions, weighted by the cosine (Conty Estevez and Kulla 2018, section 4.4).
double orientation_cost(const LightBounds& b) {
  const double spread = b.spread, reach = std::min(spread + double{b.emission}, std::numbers::pi);
  return 2 * std::numbers::pi * (1 - std::cos(spread)) +
         std::numbers::pi / 2 *
             (2 * reach * std::sin(spread) - std::cos(spread - 2 * reach) - 2 * spread * std::sin(spread) +
              std::cos(spread));
}

/// Half of the box's surface, enlarged by a little of the diagonal. A row of points has no surface, and without this
/// every split of it would cost nothing.
double half_surface(const LightBounds& b) {
  const Vec3d d(b.high - b.low);
  return d.x * d.y + d.y * d.z + d.z * d.x + 1e-3 * dot(d, d);
}

std::vector<std::optional<LightBounds>> bounds_of_all(const std::vector<Light>& lights) {
  std::vector<std::optional<LightBounds>> all;
  for (const Light& light : lights) all.push_back(light_bounds(light));
  return all;
}

constexpr std::size_t bucket_count = 12;

/// Buckets of the lights' middles along each axis.
struct Buckets {
  Vec3f low, extent;  ///< of twice the middles

  std::size_t of(const LightBounds& bounds, int axis) const {
    const float at = (2 * middle(bounds, axis) - component(low, axis)) / component(extent, axis);
    return std::min(static_cast<std::size_t>(at * bucket_count), bucket_count - 1);
  }
};

struct Split {
  int axis = -1;  ///< -1: none
  std::size_t at = 0;
};

/// Axis and bucket before which a split into two halves costs least.
template <class Entry>
Split best_split(const Entry* first, const Entry* last, const Buckets& buckets) {
  const float longest = max_component(buckets.extent);
  double best_cost = std::numeric_limits<double>::infinity();
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = component(buckets.extent, axis);
    if (!(extent > 0) || !std::isfinite(extent)) continue;
    std::array<std::optional<LightBounds>, bucket_count> bucket;
    for (const Entry* e = first; e != last; ++e) {
      auto& b = bucket[buckets.of(e->bounds, axis)];
      b = b ? merge(*b, e->bounds) : e->bounds;
    }
    const auto cost_of = [&](std::size_t from, std::size_t to) {
      std::optional<LightBounds> all;
      for (std::size_t i = from; i < to; ++i)
        if (bucket[i]) all = all ? merge(*all, *bucket[i]) : bucket[i];
      return all ? double{all->power} * orientation_cost(*all) * half_surface(*all) : 0.0;
    };
    for (std::size_t split = 1; split < bucket_count; ++split) {
      const double cost = (cost_of(0, split) + cost_of(split, bucket_count)) * double{longest / extent};
      if (!(cost < best_cost)) continue;
      best_cost = cost;
      best = {axis, split};
    }
  }
  return best;
}

}  // namespace

LightTree::LightTree(const std::vector<Light>& lights) : LightTree(bounds_of_all(lights)) {}

LightTree::LightTree(const std::vector<std::optional<LightBounds>>& lights) : leaf_of_(lights.size(), no_index) {
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i]) entries.push_back({*lights[i], i});
  nodes_.reserve(2 * entries.size());
  build(entries.data(), entries.data() + entries.size(), no_index);
}

std::uint32_t LightTree::build(Entry* first, Entry* last, std::uint32_t parent) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_[index].parent = parent;
  LightBounds bounds = first->bounds;
  if (last - first == 1) {
    nodes_[index].importance = LightImportance(bounds);
    nodes_[index].light = first->light;
    leaf_of_[first->light] = index;
    return index;
  }
  Vec3f low = bounds.low + bounds.high, high = low;  // range of twice the middles
  for (const Entry* e = first + 1; e != last; ++e) {
    bounds = merge(bounds, e->bounds);
    const Vec3f sum = e->bounds.low + e->bounds.high;
    low = {std::min(low.x, sum.x), std::min(low.y, sum.y), std::min(low.z, sum.z)};
    high = {std::max(high.x, sum.x), std::max(high.y, sum.y), std::max(high.z, sum.z)};
  }
  nodes_[index].importance = LightImportance(bounds);

  const Buckets buckets{low, high - low};
  const Split best = best_split(first, last, buckets);
  Entry* cut = first;
  if (best.axis >= 0)
    cut = std::stable_partition(first, last, [&](const Entry& e) { return buckets.of(e.bounds, best.axis) < best.at; });
  if (cut == first || cut == last) cut = first + (last - first) / 2;
  const std::uint32_t left = build(first, cut, index);
  const std::uint32_t right = build(cut, last, index);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

std::optional<float> LightTree::left_probability(const Node& node, const Vec3f& p) const {
  const float left = nodes_[node.left].importance.at(p), right = nodes_[node.right].importance.at(p);
  const float both = left + right;
  if (!(both > 0)) return std::nullopt;
  if (!std::isfinite(both)) return std::isfinite(right) ? 1.0f : std::isfinite(left) ? 0.0f : 0.5f;
  return left / both;
}

std::optional<LightTree::Choice> LightTree::choose(const Vec3f& p, float u) const {
  if (!(nodes_[0].importance.at(p) > 0)) return std::nullopt;
  float probability = 1;
  const Node* node = &nodes_[0];
  while (!node->is_leaf()) {
    const std::optional<float> left = left_probability(*node, p);
    if (!left) return std::nullopt;
    const bool goes_left = u < *left;
    u = goes_left ? u / *left : (u - *left) / (1 - *left);
    u = std::min(u, 1 - 0x1p-24f);
    probability *= goes_left ? *left : 1 - *left;
    node = &nodes_[goes_left ? node->left : node->right];
  }
  return Choice{node->light, probability, u};
}

float LightTree::probability(const Vec3f& p, std::uint32_t light) const {
  std::uint32_t at = leaf_of_[light];
  if (at == no_index || !(nodes_[0].importance.at(p) > 0)) return 0;
  float probability = 1;
  while (nodes_[at].parent != no_index) {
    const Node& parent = nodes_[nodes_[at].parent];
    const std::optional<float> left = left_probability(parent, p);
    if (!left) return 0;
    probability *= parent.left == at ? *left : 1 - *left;
    at = nodes_[at].parent;
  }
  return probability;
}

}  // namespace photonproof::inline renderer_lights
