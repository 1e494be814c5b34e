#include "renderer/light_table.h"

#include "renderer/ray.h"

namespace photonproof {

std::vector<LightWords> light_table(const std::vector<Light>& lights) {
  const std::size_t count = lights.size();
  std::vector<double> share(count);
  double total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Rgb f = flux(lights[i]);
    share[i] = (double{f.x} + f.y + f.z) / 3;
    total += share[i];
  }
  std::vector<LightWords> table(count);
  std::vector<std::size_t> poor, rich;
  for (std::size_t i = 0; i < count; ++i) {
    const double p = total > 0 ? share[i] / total : 1.0 / static_cast<double>(count);
    table[i] = {static_cast<std::uint32_t>(lights[i].index()), static_cast<float>(p), 1, static_cast<std::uint32_t>(i),
                no_index};
    share[i] = p * static_cast<double>(count);
    (share[i] < 1 ? poor : rich).push_back(i);
  }
  while (!poor.empty() && !rich.empty()) {
    const std::size_t giver = rich.back();
    const std::size_t taker = poor.back();
    poor.pop_back();
    table[taker].alias_threshold = static_cast<float>(share[taker]);
    table[taker].alias = static_cast<std::uint32_t>(giver);
    share[giver] -= 1 - share[taker];
    if (share[giver] >= 1) continue;
    rich.pop_back();
    poor.push_back(giver);
  }
  return table;
}

}  // namespace photonproof
