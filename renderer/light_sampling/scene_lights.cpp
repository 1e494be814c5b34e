#include "renderer/light_sampling/scene_lights.h"

#include <algorithm>

#include "renderer/lights/light_tree.h"

namespace photonproof::inline renderer_light_sampling {

SceneLights::SceneLights(const std::vector<Light>& lights, const std::vector<LightWords>& words, const SceneBall& ball,
                         bool by_position)
    : lights_(lights), words_(words), ball_(ball) {
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (std::holds_alternative<EnvironmentLight>(lights[i])) environment_ = i;
    if (!photonproof::is_infinite(lights[i])) continue;
    infinite_.push_back(i);
    infinite_probability_ += words[i].probability;
  }
  if (by_position && wants_tree(lights)) tree_ = std::make_unique<LightTree>(lights);
}

bool SceneLights::wants_tree(const std::vector<Light>& lights) {
  const auto is_finite = [](const Light& l) { return !photonproof::is_infinite(l) && max_component(flux(l)) > 0; };
  return static_cast<std::size_t>(std::count_if(lights.begin(), lights.end(), is_finite)) > most_in_table;
}

SceneLights::~SceneLights() = default;

bool SceneLights::is_delta(std::uint32_t light) const { return photonproof::is_delta(lights_[light]); }
bool SceneLights::is_infinite(std::uint32_t light) const { return photonproof::is_infinite(lights_[light]); }

bool SceneLights::is_outside(std::uint32_t light) const { return photonproof::is_outside(lights_[light]); }

LightSampling<float> SceneLights::chosen(std::uint32_t light, float probability) const {
  return {light, probability, words_[light].primitive};
}

LightSampling<float> SceneLights::choose(const Vec3f& p, float u) const {
  if (lights_.empty()) return {};
  if (tree_ == nullptr) return choose_by_flux<float>(words_.data(), static_cast<std::uint32_t>(count()), u);
  if (u < infinite_probability_) return choose_infinite(u);
  const float finite = 1 - infinite_probability_;
  const std::optional<LightTree::Choice> drawn =
      tree_->choose(p, std::min((u - infinite_probability_) / finite, 1 - 0x1p-24f));
  if (!drawn) return {};
  return chosen(drawn->light, drawn->probability * finite);
}

LightSampling<float> SceneLights::choose_infinite(float u) const {
  for (const std::uint32_t light : infinite_) {
    const float probability = words_[light].probability;
    if (u < probability || light == infinite_.back()) return chosen(light, probability);
    u -= probability;
  }
  return {};
}

float SceneLights::choice_probability(const Vec3f& p, std::uint32_t light) const {
  if (tree_ == nullptr || is_infinite(light)) return words_[light].probability;
  return tree_->probability(p, light) * (1 - infinite_probability_);
}

LightSeen SceneLights::sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const {
  return {photonproof::sample(lights_[light], p, u), light, is_delta(light), is_infinite(light)};
}

LightSeen SceneLights::sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const {
  const LightSampling<float> choice = choose(p, u_choice);
  if (!(choice.probability > 0)) return {};
  LightSeen seen = sample_of(choice.light, p, u);
  seen.pdf *= choice.probability;
  return seen;
}

float SceneLights::pdf_of(std::uint32_t light, const Vec3f& p, const LightPoint<float>& at) const {
  return photonproof::pdf(lights_[light], p, at);
}

float SceneLights::pdf(std::uint32_t light, const Vec3f& p, const LightPoint<float>& at) const {
  return choice_probability(p, light) * pdf_of(light, p, at);
}

float SceneLights::pdf(const Vec3f& p, const LightStart& start) const {
  if (start.is_delta) return choice_probability(p, start.light);
  if (start.is_infinite) return environment_pdf(p, -start.direction);
  return pdf(start.light, p, start.at);
}

LightStart SceneLights::start_of(std::uint32_t index, const Vec2<float>& u_position,
                                 const Vec2<float>& u_direction) const {
  const Light& light = lights_[index];
  LightStart start{{}, {}, index, is_delta(index), is_infinite(index), is_outside(index)};
  if (!guide_.guides(index)) {
    static_cast<Emission<float>&>(start) = photonproof::emit(light, u_position, u_direction);
    start.pdfs = photonproof::emit_pdfs(light, start.at, start.direction);
    return start;
  }
  const std::optional<GuidedStart> drawn = guide_.start(light, index, u_position, u_direction);
  if (!drawn) return start;
  start.at = drawn->at;
  start.direction = drawn->direction;
  start.pdfs = emit_pdfs_of(index, start.at, start.direction, drawn->on_line);
  if (drawn->ahead) start.ahead = *drawn->ahead;
  start.is_ahead = drawn->ahead ? 1 : 0;
  const bool has_side = length_squared(start.at.normal) > 0 && !start.is_infinite;
  const float cosine = has_side ? std::max(dot(start.at.normal, start.direction), 0.0f) : 1;
  start.flux = leaving(light, start.at, start.direction) * (cosine / (start.pdfs.first * start.pdfs.second));
  start.crowding = start.pdfs.first / photonproof::emit_pdfs(light, start.at, start.direction).first;
  return start;
}

LightStart SceneLights::emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  if (lights_.empty()) return {};
  const LightSampling<float> drawn =
      choose_by_flux<float>(words_.data(), static_cast<std::uint32_t>(count()), u_choice);
  if (!(drawn.probability > 0)) return {};
  LightStart start = start_of(drawn.light, u_position, u_direction);
  start.flux = start.flux / drawn.probability;
  start.pdfs.first *= drawn.probability;
  return start;
}

EmissionPdfs<float> SceneLights::emit_pdfs_of(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction,
                                              const Vec3f& on_line) const {
  EmissionPdfs<float> pdfs = photonproof::emit_pdfs(lights_[light], at, direction);
  if (is_infinite(light)) {
    const Vec3f from_axis = cross(on_line - ball_.center, direction);
    if (dot(from_axis, from_axis) > ball_.radius * ball_.radius) pdfs.second = 0;
  }
  if (guide_.guides(light)) return guide_.pdfs(lights_[light], light, at, {on_line, direction}, pdfs);
  return pdfs;
}

EmissionPdfs<float> SceneLights::emit_pdfs(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction,
                                           const Vec3f& on_line) const {
  const EmissionPdfs<float> pdfs = emit_pdfs_of(light, at, direction, on_line);
  return {pdfs.first * emission_probability(light), pdfs.second};
}

Rgb SceneLights::flux_towards(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const {
  return photonproof::flux_towards(lights_[light], at, direction);
}

Rgb SceneLights::radiance(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const {
  return leaving(lights_[light], at, direction);
}

LightPoint<float> SceneLights::with_uv(std::uint32_t light, const LightPoint<float>& at) const {
  return photonproof::with_uv(lights_[light], at);
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

bool emission_misses_planes(const std::vector<Surface>& surfaces, const std::vector<Light>& lights) {
  const auto is_endless = [](const Surface& s) { return std::holds_alternative<Plane>(s.geometry); };
  const auto is_far = [](const Light& light) { return photonproof::is_outside(light); };
  return std::ranges::any_of(surfaces, is_endless) && std::ranges::any_of(lights, is_far);
}

}  // namespace photonproof::inline renderer_light_sampling
