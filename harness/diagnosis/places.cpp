#include "harness/diagnosis/places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace photonproof::inline harness_diagnosis {
namespace {

struct Spread {
  double total = 0, x = 0, y = 0;  ///< the middle, pixels
  double share = 0;                ///< share of the image that it covers
};

Spread spread_of(const std::vector<double>& weight, int width) {
  Spread spread;
  double xx = 0, yy = 0;
  const auto columns = static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double x = static_cast<double>(i % columns) + 0.5, y = static_cast<double>(i / columns) + 0.5;
    spread.total += weight[i];
    spread.x += weight[i] * x;
    spread.y += weight[i] * y;
    xx += weight[i] * x * x;
    yy += weight[i] * y * y;
  }
  if (!(spread.total > 0)) return spread;
  spread.x /= spread.total;
  spread.y /= spread.total;
  // An even distribution over a side s has the variance s^2 / 12.
  const double wide = std::sqrt(12 * std::max(0.1, xx / spread.total - spread.x * spread.x));
  const double high = std::sqrt(12 * std::max(0.1, yy / spread.total - spread.y * spread.y));
  spread.share = wide * high / static_cast<double>(weight.size());
  return spread;
}

std::string on(const std::string& name) {
  const bool inside =
      names_object(name) && (name.find("glass") != std::string::npos || name.find("mirror") != std::string::npos);
  return (inside ? "in the " : "on the ") + name;
}

/// The body beside a place on the floor, a wall or water, in words.
std::string near_object(const Spread& spread, const SceneKnowledge& knowledge) {
  const Landmark* nearest = nullptr;
  double least = 2.6;  // radii
  for (const Landmark& mark : knowledge.landmarks) {
    if (!names_object(mark.name)) continue;
    const double away = std::hypot(spread.x - mark.x, spread.y - mark.y) / std::max(1.0, mark.radius);
    if (away < least) {
      least = away;
      nearest = &mark;
    }
  }
  if (!nearest) return "";
  const double dx = spread.x - nearest->x, dy = spread.y - nearest->y;
  if (std::abs(dy) >= 0.5 * std::abs(dx)) return (dy > 0 ? "below the " : "above the ") + nearest->name;
  return (dx > 0 ? "right of the " : "left of the ") + nearest->name;
}

}  // namespace

bool names_object(const std::string& name) {
  for (const char* word : {"sphere", "box", "object"})
    if (name.ends_with(word)) return true;
  return false;
}

std::string part_of_image(double x, double y, int width, int height) {
  const int column = std::clamp(static_cast<int>(3 * x / width), 0, 2);
  const int row = std::clamp(static_cast<int>(3 * y / height), 0, 2);
  static constexpr const char* words[3][3] = {{"upper left corner", "upper part", "upper right corner"},
                                              {"left part", "middle", "right part"},
                                              {"lower left corner", "lower part", "lower right corner"}};
  return words[row][column];
}

std::string place_of(const std::vector<double>& weight, int width, int height, const SceneKnowledge& knowledge) {
  const Spread spread = spread_of(weight, width);
  if (!(spread.total > 0)) return "";
  if (knowledge.seen.size() == weight.size() && !knowledge.landmarks.empty()) {
    std::vector<double> inside(knowledge.landmarks.size() + 1, 0);
    for (std::size_t i = 0; i < weight.size(); ++i) inside[knowledge.seen[i]] += weight[i];
    const auto most = std::max_element(inside.begin() + 1, inside.end());
    const std::string& name = knowledge.landmarks[static_cast<std::size_t>(most - inside.begin()) - 1].name;
    const bool mostly = *most > 0.6 * spread.total;
    if (mostly && names_object(name)) return on(name);
    if (spread.share < 0.12) {
      const std::string beside = near_object(spread, knowledge);
      if (!beside.empty()) return beside;
    }
    if (mostly) return on(name);
    if (spread.share < 0.12 && *most > 0.4 * spread.total) return on(name);
  }
  if (spread.share > 0.3) return "";
  return "in the " + part_of_image(spread.x, spread.y, width, height);
}

PixelRegion region_of(const std::vector<double>& weight, int width, int height) {
  std::vector<double> columns(static_cast<std::size_t>(width)), rows(static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < weight.size(); ++i) {
    columns[i % static_cast<std::size_t>(width)] += weight[i];
    rows[i / static_cast<std::size_t>(width)] += weight[i];
  }
  const auto ends = [](const std::vector<double>& sums) {
    const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
    std::size_t first = 0, last = sums.size();
    double left = 0, right = 0;
    while (first + 1 < last && left + sums[first] <= 0.025 * all) left += sums[first++];
    while (last > first + 1 && right + sums[last - 1] <= 0.025 * all) right += sums[--last];
    return std::pair(static_cast<int>(first), static_cast<int>(last));
  };
  const auto [x0, x1] = ends(columns);
  const auto [y0, y1] = ends(rows);
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace photonproof::inline harness_diagnosis
