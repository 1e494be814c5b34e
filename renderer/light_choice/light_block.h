// Between the lanes of a kernel and scene_lights.h, which answers one after the other for lights that need tables and
// for choices by position. Only arrays cross, as with the rays of trace.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scenes/meshes/vec.h"

namespace photonproof {

class SceneLights;

struct alignas(64) LightBlock {
  static constexpr std::size_t width = 16;
  using Column = float[width];
  using Column3 = Column[3];
  using Words = std::uint32_t[width];
  std::uint32_t active;  ///< bit i: lane i asks
  Words light;
};

struct LightChoiceBlock : LightBlock {
  Column3 p;
  Column u;
  Column probability;  ///< answer; 0: none
};

struct LightSampleBlock : LightBlock {
  Column3 p;
  Column u_x, u_y;
  // Answers:
  Column3 p_light, normal, wi, radiance;
  Column pdf;  ///< the choice not inside
  Words is_surface, is_delta, triangle;
};

/// Densities per solid angle at p of light points, of meshes on that triangle, or of directions of an infinite light:
/// p_light is then beyond.
struct LightPdfBlock : LightBlock {
  Column3 p, p_light, normal;
  Words triangle;
  Column pdf;  ///< answer, the choice not inside
};

struct LightEmitBlock : LightBlock {
  Column position_x, position_y, direction_x, direction_y;  ///< uniform numbers
  // Answers:
  Column3 origin, normal, direction, flux;
  Column uv_x, uv_y;
  Column crowding;  ///< density of the origin over that of an even one
  Words triangle, can_be_aimed;
};

/// What photons of such starts carry towards other directions, W sr^-1.
struct LightTowardsBlock : LightBlock {
  Column3 normal, direction;
  Column uv_x, uv_y;
  Column3 flux;  ///< answer
};

/// Radiance of surface lights that rays met at p, on their `triangle` if they are meshes.
struct LightRadianceBlock : LightBlock {
  Column3 p, normal, direction;  ///< of travel, away from the light
  Words triangle;
  Column3 radiance;  ///< answer
};

struct EnvironmentBlock : LightBlock {
  Column3 direction;  ///< towards the environment
  Column3 radiance;   ///< answer
  Column pdf;         ///< answer, the choice not inside
};

void choose_lights(const SceneLights& lights, LightChoiceBlock& block);
/// The probabilities of block.light's being chosen from p.
void choice_probabilities(const SceneLights& lights, LightChoiceBlock& block);
void sample_lights(const SceneLights& lights, LightSampleBlock& block);
void light_pdfs(const SceneLights& lights, LightPdfBlock& block);
void emit_from_lights(const SceneLights& lights, LightEmitBlock& block);
void flux_towards(const SceneLights& lights, LightTowardsBlock& block);
void radiance_of_lights(const SceneLights& lights, LightRadianceBlock& block);
void look_at_environment(const SceneLights& lights, EnvironmentBlock& block);

}  // namespace photonproof
