#include "renderer/scalar/world_lights.h"

namespace photonproof {

WorldLights::WorldLights(const World& world)
    : world_(world), lights_(world.scene().scene_lights()), surface_(world.scene().lights.size(), no_index) {
  const std::vector<Surface>& surfaces = world.scene().surfaces;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].light != no_index) surface_[surfaces[i].light] = i;
}

SegmentEnd WorldLights::end(std::uint32_t light, const Vec3f& p, const Vec3f& normal, std::uint32_t triangle) const {
  const std::uint32_t first = world_.view().light_words[light].primitive;
  return {p, normal, first == no_index ? no_index : first + triangle, surface_[light], lights_.is_infinite(light)};
}

LightSeen WorldLights::seen(const LightSample<float>& s, std::uint32_t light, std::uint32_t triangle) const {
  return {end(light, s.p_light, s.normal_light, triangle),
          s.wi_world,
          s.radiance,
          s.pdf,
          light,
          triangle,
          lights_.is_delta(light),
          lights_.is_infinite(light)};
}

LightSeen WorldLights::sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const {
  if (const auto* area = std::get_if<AreaLight>(&lights_.light(light))) {
    const auto [sample, triangle] = area->sample_point(p, u);
    return seen(sample, light, triangle);
  }
  return seen(std::visit([&](const auto& l) { return l.sample(p, u); }, lights_.light(light)), light, 0);
}

LightSeen WorldLights::sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const {
  const SceneLights::Choice choice = lights_.choose(p, u_choice);
  if (!(choice.probability > 0)) return {};
  LightSeen found = sample_of(choice.light, p, u);
  found.pdf *= choice.probability;
  return found;
}

float WorldLights::sample_pdf(const Vec3f& p, const LightStart& start) const {
  if (start.delta) return lights_.choice_probability(p, start.light);
  if (start.infinite) return lights_.environment_pdf(p, -start.direction);
  return lights_.pdf(p, start.light, start.end.p, start.end.normal, start.triangle);
}

LightStart WorldLights::emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  const LightEmission e = lights_.emit(u_choice, u_position, u_direction);
  if (!(e.probability > 0)) return {};
  LightStart start;
  start.end = {e.origin, e.normal, no_index, surface_[e.light], e.is_infinite};
  start.direction = e.direction;
  start.weight = e.flux;
  start.pdf = e.is_infinite ? EmissionPdf{e.pdf_direction * e.probability, e.pdf_position}
                            : EmissionPdf{e.pdf_position * e.probability, e.pdf_direction};
  start.uv = e.uv;
  start.light = e.light;
  start.triangle = e.triangle;
  start.delta = e.is_delta_position || e.is_delta_direction;
  start.infinite = e.is_infinite;
  if (!std::holds_alternative<AreaLight>(lights_.light(e.light))) start.end = end(e.light, e.origin, e.normal, 0);
  return start;
}

EmissionPdf WorldLights::emit_pdf(std::uint32_t light, const Vec3f& p, const Vec3f& normal, std::uint32_t triangle,
                                  const Vec3f& direction) const {
  const EmissionPdfs<float> pdfs = lights_.emission_pdfs(light, p, normal, triangle, direction);
  const float probability = lights_.emission_probability(light);
  return lights_.is_infinite(light) ? EmissionPdf{pdfs.direction * probability, pdfs.position}
                                    : EmissionPdf{pdfs.position * probability, pdfs.direction};
}

std::uint32_t WorldLights::triangle_of(const Interaction& met) const {
  return met.primitive - (world_.view().small ? world_.view().light_words[met.light].primitive : 0);
}

Rgb WorldLights::radiance(const Interaction& met, const Vec3f& direction) const {
  Vec2<float> uv{0, 0};
  if (const auto* area = std::get_if<AreaLight>(&lights_.light(met.light))) uv = area->uv_at(met.p, triangle_of(met));
  return lights_.emitted_radiance(met.light, met.ng, uv, direction);
}

Rgb WorldLights::radiance(const LightStart& start, const Vec3f& direction) const {
  return lights_.emitted_radiance(start.light, start.end.normal, start.uv, direction);
}

}  // namespace photonproof
