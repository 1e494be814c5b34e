#include "renderer/light_choice/light_block.h"

#include <bit>
#include <tuple>

#include "renderer/light_choice/scene_lights.h"

namespace photonproof {
namespace {

template <class Body>
void for_each_lane(const LightBlock& block, Body&& body) {
  for (std::uint32_t bits = block.active; bits != 0; bits &= bits - 1)
    body(static_cast<std::size_t>(std::countr_zero(bits)));
}

Vec3f get(const LightBlock::Column3& columns, std::size_t lane) {
  return {columns[0][lane], columns[1][lane], columns[2][lane]};
}

void put(LightBlock::Column3& columns, std::size_t lane, const Vec3f& v) {
  columns[0][lane] = v.x;
  columns[1][lane] = v.y;
  columns[2][lane] = v.z;
}

}  // namespace

void choose_lights(const SceneLights& lights, LightChoiceBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    const SceneLights::Choice choice = lights.choose(get(block.p, i), block.u[i]);
    block.light[i] = choice.light;
    block.probability[i] = choice.probability;
  });
}

void choice_probabilities(const SceneLights& lights, LightChoiceBlock& block) {
  for_each_lane(
      block, [&](std::size_t i) { block.probability[i] = lights.choice_probability(get(block.p, i), block.light[i]); });
}

void sample_lights(const SceneLights& lights, LightSampleBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    const Light& light = lights.light(block.light[i]);
    const Vec3f p = get(block.p, i);
    const Vec2<float> u{block.u_x[i], block.u_y[i]};
    LightSample<float> s{};
    std::uint32_t triangle = 0;
    if (const auto* area = std::get_if<AreaLight>(&light))
      std::tie(s, triangle) = area->sample_point(p, u);
    else
      s = std::visit([&](const auto& l) { return l.sample(p, u); }, light);
    put(block.p_light, i, s.p_light);
    put(block.normal, i, s.normal_light);
    put(block.wi, i, s.wi_world);
    put(block.radiance, i, s.radiance);
    block.pdf[i] = s.pdf;
    block.is_delta[i] = is_delta(light) ? 1 : 0;
    block.is_surface[i] = !is_delta(light) && !is_infinite(light) ? 1 : 0;
    block.triangle[i] = triangle;
  });
}

void light_pdfs(const SceneLights& lights, LightPdfBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    block.pdf[i] = density_from(lights.light(block.light[i]), get(block.p, i), get(block.p_light, i),
                                get(block.normal, i), block.triangle[i]);
  });
}

void emit_from_lights(const SceneLights& lights, LightEmitBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    const SceneLights::Start start = lights.start(block.light[i], {block.position_x[i], block.position_y[i]},
                                                  {block.direction_x[i], block.direction_y[i]});
    put(block.origin, i, start.emission.p_world);
    put(block.normal, i, start.emission.normal);
    put(block.direction, i, start.emission.direction);
    put(block.flux, i, start.emission.flux);
    block.uv_x[i] = start.uv.x;
    block.uv_y[i] = start.uv.y;
    block.crowding[i] = start.crowding;
    block.triangle[i] = start.triangle;
    block.can_be_aimed[i] = lights.is_infinite(block.light[i]) ? 0 : 1;
  });
}

void flux_towards(const SceneLights& lights, LightTowardsBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    const Vec3f n = get(block.normal, i), direction = get(block.direction, i);
    const Vec2<float> uv{block.uv_x[i], block.uv_y[i]};
    put(block.flux, i,
        std::visit(
            [&](const auto& l) {
              if constexpr (std::is_same_v<std::decay_t<decltype(l)>, AreaLight>)
                return l.flux_towards(n, uv, direction);
              else
                return l.flux_towards(n, direction);
            },
            lights.light(block.light[i])));
  });
}

void radiance_of_lights(const SceneLights& lights, LightRadianceBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    const Light& light = lights.light(block.light[i]);
    Vec2<float> uv;
    if (const auto* area = std::get_if<AreaLight>(&light)) uv = area->uv_at(get(block.p, i), block.triangle[i]);
    put(block.radiance, i, lights.emitted_radiance(block.light[i], get(block.normal, i), uv, get(block.direction, i)));
  });
}

void look_at_environment(const SceneLights& lights, EnvironmentBlock& block) {
  for_each_lane(block, [&](std::size_t i) {
    const Vec3f direction = get(block.direction, i);
    const auto& sky = std::get<EnvironmentLight>(lights.light(block.light[i]));
    put(block.radiance, i, sky.radiance(direction));
    block.pdf[i] = sky.pdf_direction(direction);
  });
}

}  // namespace photonproof
