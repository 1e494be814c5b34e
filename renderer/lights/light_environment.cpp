#include "renderer/lights/light_environment.h"

#include <utility>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {

EnvironmentLight::EnvironmentLight(Sky sky, const Vec3f& center, float radius)
    : sky_(std::move(sky)), center_(center), radius_(radius) {}

LightSample<float> EnvironmentLight::sample(const Vec3f& p, const Vec2<float>& u) const {
  const Vec3f wi = std::visit([&](const auto& sky) { return sky.sample(u); }, sky_);
  return {{p + wi * reach_beyond(center_, radius_, p)}, wi, radiance(wi), pdf_direction(wi)};
}

float EnvironmentLight::pdf(const Vec3f& p, const LightPoint<float>& at) const {
  return pdf_direction(normalize(at.p - p));
}

Emission<float> EnvironmentLight::emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  const Vec3f towards_sky = std::visit([&](const auto& sky) { return sky.sample(u_direction); }, sky_);
  const float pdf = pdf_direction(towards_sky);
  const Vec2<float> d = square_to_disc(u_position);
  const Vec3f across = Frame<float>(towards_sky).to_world({d.x, d.y, 1});
  const Rgb flux = pdf > 0 ? radiance(towards_sky) * (pi * radius_ * radius_ / pdf) : Rgb(0.0f);
  return {{center_ + across * radius_}, -towards_sky, flux};
}

EmissionPdfs<float> EnvironmentLight::emit_pdfs(const LightPoint<float>&, const Vec3f& direction) const {
  return {pdf_direction(-direction), 1 / (pi * radius_ * radius_)};
}

Rgb EnvironmentLight::flux() const {
  return std::visit([](const auto& sky) { return sky.irradiance(); }, sky_) * (pi * radius_ * radius_);
}

Rgb EnvironmentLight::radiance(const Vec3f& towards_sky) const {
  return std::visit([&](const auto& sky) { return sky.radiance(towards_sky); }, sky_);
}

float EnvironmentLight::pdf_direction(const Vec3f& towards_sky) const {
  return std::visit([&](const auto& sky) { return sky.pdf(towards_sky); }, sky_);
}

}  // namespace photonproof::inline renderer_lights
