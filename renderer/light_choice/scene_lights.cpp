#include "renderer/light_choice/scene_lights.h"

#include <algorithm>
#include <tuple>
#include <type_traits>

#include "renderer/light_choice/light_choice.h"
#include "renderer/lights/light_tree.h"

namespace photonproof {
namespace {

template <class L>
constexpr bool has_uv = std::is_same_v<std::decay_t<L>, AreaLight>;

Rgb leaving(const Light& light, const Vec3f& n, const Vec2<float>& uv, const Vec3f& direction) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (has_uv<decltype(l)>)
          return l.leaving(n, uv, direction);
        else
          return l.leaving(n, direction);
      },
      light);
}

/// Without a guide.
EmissionPdfs<float> even_pdfs(const Light& light, const Vec3f& n, const Vec3f& direction) {
  return std::visit([&](const auto& l) { return l.emit_pdfs(n, direction); }, light);
}

}  // namespace

SceneLights::SceneLights(const std::vector<Light>& lights, const std::vector<LightWords>& words, const SceneBall& ball)
    : lights_(lights), words_(words), ball_(ball) {
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (std::holds_alternative<EnvironmentLight>(lights[i])) environment_ = i;
    if (!photonproof::is_infinite(lights[i])) continue;
    infinite_.push_back(i);
    infinite_probability_ += words[i].probability;
  }
  if (wants_tree(lights)) tree_ = std::make_unique<LightTree>(lights);
}

bool SceneLights::wants_tree(const std::vector<Light>& lights) {
  const auto is_finite = [](const Light& l) { return !photonproof::is_infinite(l) && max_component(flux(l)) > 0; };
  return static_cast<std::size_t>(std::count_if(lights.begin(), lights.end(), is_finite)) > most_in_table;
}

SceneLights::~SceneLights() = default;

SceneLights::Choice SceneLights::choose(const Vec3f& p, float u) const {
  if (lights_.empty()) return {};
  if (tree_ == nullptr) {
    const LightChoice<float> drawn = choose_by_flux<float>(words_.data(), static_cast<std::uint32_t>(count()), u);
    return {drawn.light, drawn.probability};
  }
  if (u < infinite_probability_) return choose_infinite(u);
  const float finite = 1 - infinite_probability_;
  const std::optional<LightTree::Choice> drawn =
      tree_->choose(p, std::min((u - infinite_probability_) / finite, 1 - 0x1p-24f));
  if (!drawn) return {};
  return {drawn->light, drawn->probability * finite};
}

SceneLights::Choice SceneLights::choose_infinite(float u) const {
  for (const std::uint32_t light : infinite_) {
    const float probability = words_[light].probability;
    if (u < probability || light == infinite_.back()) return {light, probability};
    u -= probability;
  }
  return {};
}

float SceneLights::choice_probability(const Vec3f& p, std::uint32_t light) const {
  if (tree_ == nullptr || is_infinite(light)) return words_[light].probability;
  return tree_->probability(p, light) * (1 - infinite_probability_);
}

LightConnection SceneLights::sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const {
  const Choice chosen = choose(p, u_choice);
  LightConnection c;
  if (!(chosen.probability > 0)) return c;
  const Light& light = lights_[chosen.light];
  LightSample<float> s{};
  if (const auto* area = std::get_if<AreaLight>(&light))
    std::tie(s, c.triangle) = area->sample_point(p, u);
  else
    s = std::visit([&](const auto& l) { return l.sample(p, u); }, light);
  if (!(s.pdf > 0)) return c;
  c.light = chosen.light;
  c.p_light = s.p_light;
  c.normal = s.normal_light;
  c.wi = s.wi_world;
  c.distance = length(s.p_light - p);
  c.radiance = s.radiance;
  c.probability = chosen.probability;
  c.pdf = s.pdf * chosen.probability;
  c.is_delta = photonproof::is_delta(light);
  c.is_infinite = photonproof::is_infinite(light);
  return c;
}

float SceneLights::pdf(const Vec3f& p, std::uint32_t light, const Vec3f& p_light, const Vec3f& n,
                       std::uint32_t triangle) const {
  return choice_probability(p, light) * density_from(lights_[light], p, p_light, n, triangle);
}

SceneLights::Start SceneLights::start(std::uint32_t index, const Vec2<float>& u_position,
                                      const Vec2<float>& u_direction) const {
  const Light& light = lights_[index];
  Start start{};
  if (guide_.guides(index)) {
    const std::optional<GuidedStart> drawn = guide_.start(light, index, u_position, u_direction);
    if (!drawn) return start;
    start.uv = drawn->uv;
    start.triangle = drawn->triangle;
    start.emission = {drawn->p, drawn->normal, drawn->direction, Rgb(0.0f)};
    start.pdfs = emission_pdfs(index, drawn->on_line, drawn->normal, drawn->triangle, drawn->direction);
    const float cosine = is_infinite(index) ? 1 : std::max(dot(drawn->normal, drawn->direction), 0.0f);
    start.emission.flux = leaving(light, drawn->normal, drawn->uv, drawn->direction) *
                          (cosine / (start.pdfs.position * start.pdfs.direction));
    start.crowding = start.pdfs.position / even_pdfs(light, drawn->normal, drawn->direction).position;
    return start;
  }
  const AreaLight::Start even = even_start(light, u_position, u_direction);
  start.emission = even.emission;
  start.uv = even.uv;
  start.triangle = even.triangle;
  start.pdfs = even_pdfs(light, start.emission.normal, start.emission.direction);
  return start;
}

LightEmission SceneLights::emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  LightEmission e;
  if (lights_.empty()) return e;
  const LightChoice<float> drawn = choose_by_flux<float>(words_.data(), static_cast<std::uint32_t>(count()), u_choice);
  const Light& light = lights_[drawn.light];
  const Start from = this->start(drawn.light, u_position, u_direction);
  const Emission<float>& start = from.emission;
  e.uv = from.uv;
  e.triangle = from.triangle;
  e.light = drawn.light;
  e.origin = start.p_world;
  e.normal = start.normal;
  e.direction = start.direction;
  e.radiance = leaving(light, start.normal, e.uv, start.direction);
  e.probability = drawn.probability;
  e.flux = drawn.probability > 0 ? start.flux / drawn.probability : Rgb(0.0f);
  e.pdf_position = from.pdfs.position;
  e.pdf_direction = from.pdfs.direction;
  e.is_infinite = photonproof::is_infinite(light);
  const bool no_surface = start.normal == Vec3f(0.0f);
  e.is_delta_position = no_surface && !e.is_infinite;
  e.is_delta_direction = e.is_infinite && photonproof::is_delta(light);
  return e;
}

EmissionPdfs<float> SceneLights::emission_pdfs(std::uint32_t light, const Vec3f& p, const Vec3f& n,
                                               std::uint32_t triangle, const Vec3f& direction) const {
  EmissionPdfs<float> pdfs = even_pdfs(lights_[light], n, direction);
  if (is_infinite(light)) {
    const Vec3f from_axis = cross(p - ball_.center, direction);
    if (dot(from_axis, from_axis) > ball_.radius * ball_.radius) pdfs.position = 0;
  }
  if (guide_.guides(light)) return guide_.pdfs(lights_[light], light, p, n, triangle, direction, pdfs);
  return pdfs;
}

float SceneLights::emission_probability(std::uint32_t light) const { return words_[light].probability; }

Rgb SceneLights::emitted_radiance(std::uint32_t light, const Vec3f& n, const Vec2<float>& uv, const Vec3f& w) const {
  return leaving(lights_[light], n, uv, w);
}

Rgb SceneLights::environment_radiance(const Vec3f& direction) const {
  if (!environment_) return Rgb(0.0f);
  return std::get<EnvironmentLight>(lights_[*environment_]).radiance(direction);
}

float SceneLights::environment_pdf(const Vec3f& p, const Vec3f& direction) const {
  if (!environment_) return 0;
  return choice_probability(p, *environment_) *
         std::get<EnvironmentLight>(lights_[*environment_]).pdf_direction(direction);
}

}  // namespace photonproof
