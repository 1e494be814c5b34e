#include "renderer/irradiance/cache_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "renderer/photons/surface_side.h"
#include "renderer/sensor/camera.h"

namespace photonproof::inline renderer_irradiance {
namespace {

constexpr float brightest_grey = 0.3f, half_as_bright = 0.5f;
constexpr float dot_radius = 1;  // pixels
constexpr float shortest_reach = 1.5f, longest_reach = 24;

float dimmed(const Rgb& radiance) {
  const float brightness = (radiance.x + radiance.y + radiance.z) / 3;
  return brightness > 0 ? brightest_grey * brightness / (half_as_bright + brightness) : 0.0f;
}

}  // namespace

Rgb colour_of_reach(float pixels) {
  static constexpr std::array<Rgb, 4> colours{Rgb{1, 0.05f, 0.05f}, Rgb{1, 0.85f, 0}, Rgb{0.1f, 0.9f, 0.2f},
                                              Rgb{0.15f, 0.4f, 1}};
  const float part = std::log(pixels / shortest_reach) / std::log(longest_reach / shortest_reach);
  const float at = std::clamp(part, 0.0f, 1.0f) * static_cast<float>(colours.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), colours.size() - 2);
  const float above = at - static_cast<float>(below);
  return colours[below] * (1 - above) + colours[below + 1] * above;
}

std::vector<Rgb> cache_picture(const IrradianceCache& cache, const CameraView& camera, const PicturedPaths& paths) {
  std::vector<Rgb> dots(paths.count.size(), Rgb(0.0f));
  std::vector<std::uint32_t> dotted(paths.count.size(), 0);
  for (std::size_t i = 0; i < paths.ends.size(); ++i) {
    const GatherPoint end = paths.ends[i];
    const IrradianceRecord* record = cache.nearest(end.p, facing_side_normal(end.surface_side));
    if (record == nullptr) continue;
    const float pixel = pixel_footprint(camera, record->p);
    if (!(length(end.p - record->p) < dot_radius * pixel)) continue;
    dots[paths.pixel_of[end.path]] += colour_of_reach(cache.reach(*record) / pixel);
    ++dotted[paths.pixel_of[end.path]];
  }
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const auto count = static_cast<float>(paths.count[i]);
    const auto others = static_cast<float>(paths.count[i] - std::min(dotted[i], paths.count[i]));
    dots[i] = (dots[i] + Rgb(others * dimmed(paths.sum[i] * (1 / count)))) * (1 / count);
  }
  return dots;
}

}  // namespace photonproof::inline renderer_irradiance
