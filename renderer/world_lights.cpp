#include "renderer/world_lights.h"

#include "renderer/kernels/lights.h"

namespace photonproof {
namespace {

/// Density per area of a path's start; 1 for a light of no size.
float start_pdf(const QuadLight<float>& light) { return 1 / light.area; }
float start_pdf(const SphereLight<float>& light) { return 1 / (4 * pi * light.radius * light.radius); }
float start_pdf(const PointLight<float>&) { return 1; }

}  // namespace

WorldLights::WorldLights(const World& world) : world_(world), surface_(world.scene().lights.size(), no_index) {
  const std::vector<Surface>& surfaces = world.scene().surfaces;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].light != no_index) surface_[surfaces[i].light] = i;
}

WorldLights::Choice WorldLights::choose(float u) const {
  const LightChoice<float> choice = choose_light<float>(world_.view(), u);
  return {choice.light, choice.probability};
}
float WorldLights::probability(std::uint32_t light) const {
  return world_.view().one_light ? 1.0f : world_.view().light_words[light].probability;
}
std::uint32_t WorldLights::primitive(std::uint32_t light) const { return world_.view().light_words[light].primitive; }

LightSeen WorldLights::sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const {
  return std::visit(
      [&](const auto& l) -> LightSeen {
        const LightSample<float> s = l.sample(p, u);
        return {{s.p_light, s.normal_light, primitive(light), surface_[light]},
                s.wi_world,
                s.radiance,
                s.pdf,
                light,
                l.is_delta,
                false};
      },
      world_.scene().lights[light]);
}

LightSeen WorldLights::sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const {
  if (count() == 0) return {};
  const Choice choice = choose(u_choice);
  LightSeen seen = sample_of(choice.light, p, u);
  seen.pdf *= choice.probability;
  return seen;
}

float WorldLights::sample_pdf(const Vec3f& p, std::uint32_t light, const Vec3f& q, const Vec3f& normal) const {
  return probability(light) *
         std::visit([&](const auto& l) { return l.pdf(p, q, normal); }, world_.scene().lights[light]);
}

LightStart WorldLights::emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  const Choice choice = choose(u_choice);
  return std::visit(
      [&](const auto& l) -> LightStart {
        const Emission<float> e = l.emit(u_position, u_direction);
        const float pdf_direction = l.emit_pdf(dot(e.normal, e.direction));
        return {{e.p_world, e.normal, primitive(choice.light), surface_[choice.light]},
                e.direction,
                l.flux() / choice.probability,
                {start_pdf(l) * choice.probability, pdf_direction},
                choice.light,
                l.is_delta,
                false};
      },
      world_.scene().lights[choice.light]);
}

EmissionPdf WorldLights::emit_pdf(std::uint32_t light, const Vec3f& normal, const Vec3f& direction) const {
  return std::visit(
      [&](const auto& l) -> EmissionPdf {
        return {start_pdf(l) * probability(light), l.emit_pdf(dot(normal, direction))};
      },
      world_.scene().lights[light]);
}

Rgb WorldLights::radiance(std::uint32_t light, const Vec3f& normal, const Vec3f& direction) const {
  return std::visit([&](const auto& l) { return l.emitted_radiance(dot(normal, direction)); },
                    world_.scene().lights[light]);
}

}  // namespace photonproof
