#include "renderer/lights/light_projector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace photonproof::inline renderer_lights {
namespace {

/// Share of photons that start evenly: a cell that looks dark at the points of its mean may still have light.
constexpr double even_share = 0.05;

}  // namespace

ProjectorLight::ProjectorLight(const ProjectorScreen& screen, LightTexture image, int cells, int steps)
    : screen_(screen), image_(std::move(image)), cells_(cells) {
  const int points = cells * steps;
  std::vector<double> weights(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  RgbD sum(0.0);
  for (int row = 0; row < points; ++row)
    for (int column = 0; column < points; ++column) {
      const Rgb colour = image_({(static_cast<float>(column) + 0.5f) / static_cast<float>(points),
                                 (static_cast<float>(row) + 0.5f) / static_cast<float>(points)});
      weights[static_cast<std::size_t>(row / steps * cells + column / steps)] +=
          double{colour.x} + double{colour.y} + double{colour.z};
      sum += RgbD(colour);
    }
  const double total = sum.x + sum.y + sum.z;
  for (double& weight : weights) weight += even_share * total / static_cast<double>(weights.size());
  distribution_ = DiscreteDistribution(weights);
  const double area = 4.0 * double{screen.half_width} * double{screen.half_height};
  flux_ = Rgb(sum * (area / (double(points) * double(points))));
}

ProjectorLight::Seen ProjectorLight::seen(const Vec3f& direction) const {
  const float cosine = dot(direction, screen_.axis);
  if (!(cosine > 0)) return {{}, cosine, false};
  const Vec2<float> uv{0.5f + 0.5f * dot(direction, screen_.right) / (cosine * screen_.half_width),
                       0.5f + 0.5f * dot(direction, screen_.down) / (cosine * screen_.half_height)};
  return {uv, cosine, uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1};
}

float ProjectorLight::cell_area() const {
  return 4 * screen_.half_width * screen_.half_height / (static_cast<float>(cells_) * static_cast<float>(cells_));
}

// A patch dA of the screen is 1 / cosine away and seen at an angle: it covers the solid angle cosine^3 dA. So the
// intensity is the irradiance over cosine^3.
Rgb ProjectorLight::leaving(const LightPoint<float>&, const Vec3f& direction) const {
  const Seen s = seen(direction);
  if (!s.inside) return Rgb(0.0f);
  return image_(s.uv) / (s.cosine * s.cosine * s.cosine);
}

LightSample<float> ProjectorLight::sample(const Vec3f& p, const Vec2<float>&) const {
  const Vec3f d = screen_.position - p;
  const float inverse = 1 / length(d);
  const Vec3f wi = d * inverse;
  const Rgb intensity = dot(d, d) > 0 ? leaving({screen_.position}, -wi) : Rgb(0.0f);
  return {{screen_.position}, wi, intensity * (inverse * inverse), max_component(intensity) > 0 ? 1.0f : 0.0f};
}

Emission<float> ProjectorLight::emit(const Vec2<float>&, const Vec2<float>& u) const {
  const DiscreteDistribution::Drawn drawn = distribution_.sample(u.x);
  const auto cell = static_cast<int>(drawn.index);
  const Vec2<float> uv{(static_cast<float>(cell % cells_) + drawn.u) / static_cast<float>(cells_),
                       (static_cast<float>(cell / cells_) + u.y) / static_cast<float>(cells_)};
  const Vec3f on_screen = screen_.axis + screen_.right * ((2 * uv.x - 1) * screen_.half_width) +
                          screen_.down * ((2 * uv.y - 1) * screen_.half_height);
  return {{screen_.position}, normalize(on_screen), image_(uv) * (cell_area() / drawn.probability)};
}

EmissionPdfs<float> ProjectorLight::emit_pdfs(const LightPoint<float>&, const Vec3f& direction) const {
  const Seen s = seen(direction);
  if (!s.inside) return {1, 0};
  const auto place = [&](float t) { return std::min(static_cast<int>(t * static_cast<float>(cells_)), cells_ - 1); };
  const auto cell = static_cast<std::size_t>(place(s.uv.y) * cells_ + place(s.uv.x));
  return {1, distribution_.probability(cell) / (cell_area() * s.cosine * s.cosine * s.cosine)};
}

LightBounds ProjectorLight::bounds() const {
  const float corner = std::atan(std::hypot(screen_.half_width, screen_.half_height));
  return {screen_.position, screen_.position, screen_.axis, 0, corner, 0};
}

}  // namespace photonproof::inline renderer_lights
