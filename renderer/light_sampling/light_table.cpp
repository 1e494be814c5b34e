#include "renderer/light_sampling/light_table.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "renderer/core/ray.h"

namespace photonproof::inline renderer_light_sampling {

namespace {

std::vector<double> probabilities_by_flux(const std::vector<Light>& lights) {
  const std::size_t count = lights.size();
  std::vector<double> share(count);
  std::array<double, 2> power{};         // of finite and of infinite lights
  std::array<std::size_t, 2> shining{};  // number of lights with flux
  for (std::size_t i = 0; i < count; ++i) {
    const Rgb f = flux(lights[i]);
    share[i] = std::max((double{f.x} + f.y + f.z) / 3, 0.0);
    power[is_infinite(lights[i]) ? 1 : 0] += share[i];
    if (share[i] > 0) ++shining[is_infinite(lights[i]) ? 1 : 0];
  }
  std::array<double, 2> together{1, 1};  // share of each group
  if (shining[0] > 0 && shining[1] > 0) {
    const auto equal = static_cast<double>(shining[1]) / static_cast<double>(shining[0] + shining[1]);
    together[1] = std::clamp(power[1] / (power[0] + power[1]), std::min(equal, 0.5), 0.5);
    together[0] = 1 - together[1];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t group = is_infinite(lights[i]) ? 1 : 0;
    if (share[i] > 0)
      share[i] = together[group] * 0.5 * (share[i] / power[group] + 1 / static_cast<double>(shining[group]));
  }
  if (shining[0] + shining[1] == 0) share.assign(count, 1.0 / static_cast<double>(count));
  return share;
}

}  // namespace

std::vector<LightWords> light_table(const std::vector<Light>& lights) {
  return light_table(lights, probabilities_by_flux(lights));
}

std::vector<LightWords> light_table(const std::vector<Light>& lights, const std::vector<double>& probabilities) {
  const std::size_t count = lights.size();
  std::vector<double> share(count);
  std::vector<LightWords> table(count);
  std::vector<std::size_t> poor, rich;
  for (std::size_t i = 0; i < count; ++i) {
    const double p = probabilities[i];
    table[i] = {kernel_kind(lights[i]), static_cast<float>(p), 1, static_cast<std::uint32_t>(i), no_index};
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

std::vector<float> light_records(const std::vector<Light>& lights) {
  std::vector<float> records(lights.size() * LightKinds::stride, 0.0f);
  for (std::size_t i = 0; i < lights.size(); ++i)
    std::visit(
        [&](const auto& light) {
          if constexpr (std::is_constructible_v<LightKinds::Variant, decltype(light)>)
            std::memcpy(&records[i * LightKinds::stride], &light, sizeof light);
        },
        lights[i]);
  return records;
}

}  // namespace photonproof::inline renderer_light_sampling
