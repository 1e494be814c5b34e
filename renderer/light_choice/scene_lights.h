// One scalar interface over every kind of light, for estimators that follow one history at a time.
//
// Kinds of light, and what `radiance` and the densities mean for them:
//   surface      (rectangle, sphere, disk, cylinder, mesh)  radiance, W m^-2 sr^-1; position density per area
//   point-like   (point, spot, ies)   intensity, W sr^-1; the position is a delta: density 1
//   environment  (constant, envmap, sunsky)  radiance; no position of its own, see below
//   directional  irradiance on a surface that faces it, W m^-2; the direction is a delta: density 1
//
// Emission. A surface light's photon starts at a point with density pdf_position per area and leaves with density
// pdf_direction per solid angle. An infinite light's direction of travel is drawn first, with pdf_direction per solid
// angle (1 for a directional light); then the point where it enters, uniformly on the disc across that direction that
// covers the ball around the scene: pdf_position = 1 / (pi radius^2) per area across the direction. What a photon
// carries is in every case
//   flux = radiance |cos| / (pdf_position pdf_direction), divided by the probability of the light,
// where |cos| is that of the emission's normal, 1 without one: infinite lights count as the disc, facing the scene.
// A bidirectional estimator's density of the first vertex on a surface y met by the photon is then
//   finite lights     pdf_direction |cos_y| / distance^2 per area
//   infinite lights   pdf_position |cos_y| per area, and pdf_direction takes the place of the light vertex's own
//   density
//
// The ball holds all shapes but infinite planes, which emission of infinite lights does not cover outside of it:
// emission_pdfs is 0 there, so that weights of multiple importance sampling hold.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/light_choice/emission_guide.h"
#include "renderer/light_choice/light_words.h"
#include "renderer/lights/light.h"
#include "renderer/shapes/surface.h"

namespace photonproof {

class LightTree;

/// A point or a direction of a light, seen from a reference point.
struct LightConnection {
  std::uint32_t light = 0;
  Vec3f p_light;  ///< of an infinite light: beyond the ball, where shadow segments end
  Vec3f normal;   ///< of a surface light, unit; else 0
  Vec3f wi;       ///< unit, from the reference point
  float distance = 0;
  Rgb radiance;           ///< arriving along wi; of a delta light the irradiance at normal incidence (1/d^2 inside)
  float pdf = 0;          ///< per solid angle, 1 for a delta light, times `probability`; 0: no light from here
  float probability = 0;  ///< of having chosen this light
  std::uint32_t triangle = 0;  ///< of a mesh
  bool is_delta = false;       ///< no ray finds it: sampling it is the only strategy
  bool is_infinite = false;
};

struct LightEmission {
  std::uint32_t light = 0;
  Vec3f origin;                     ///< on the light; of an infinite one on the disc before the scene
  Vec3f normal;                     ///< of a surface light, unit; else 0
  Vec3f direction;                  ///< unit
  Vec2<float> uv;                   ///< of a surface light with a texture
  Rgb radiance;                     ///< as the table above says
  Rgb flux;                         ///< radiance |cos| / (pdf_position pdf_direction probability)
  float pdf_position = 0;           ///< probability not inside
  float pdf_direction = 0;          ///< probability not inside
  std::uint32_t triangle = 0;       ///< of a mesh
  float probability = 0;            ///< of having chosen this light
  bool is_delta_position = false;   ///< a point-like light
  bool is_delta_direction = false;  ///< a directional light
  bool is_infinite = false;
};

class SceneLights {
 public:
  /// `words`: the scene's light_table. More than `most_in_table` finite lights are chosen by position (light_tree.h).
  /// What is passed must outlive this.
  SceneLights(const std::vector<Light>& lights, const std::vector<LightWords>& words, const SceneBall& ball);
  ~SceneLights();
  SceneLights(const SceneLights&) = delete;
  SceneLights& operator=(const SceneLights&) = delete;

  std::size_t count() const { return lights_.size(); }
  const SceneBall& ball() const { return ball_; }
  bool is_delta(std::uint32_t light) const { return photonproof::is_delta(lights_[light]); }
  bool is_infinite(std::uint32_t light) const { return photonproof::is_infinite(lights_[light]); }

  /// Chooses a light for the reference point p, and a point or direction of it. Without lights pdf is 0.
  LightConnection sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const;
  /// The density with which `sample` from p gives the point p_light, with normal n, of a surface light; of a mesh, on
  /// that triangle.
  float pdf(const Vec3f& p, std::uint32_t light, const Vec3f& p_light, const Vec3f& n, std::uint32_t triangle) const;
  struct Choice {
    std::uint32_t light = 0;
    float probability = 0;
  };
  /// What `sample` begins with. Without a light that could shine there, the probability is 0.
  Choice choose(const Vec3f& p, float u) const;
  /// The probability with which `sample` from p chooses this light.
  float choice_probability(const Vec3f& p, std::uint32_t light) const;

  /// Light paths start where what the camera sees gets its light from (emission_guide.h), from now on.
  void guide_emission(EmissionGuide guide) { guide_ = std::move(guide); }
  bool has_guide() const { return !guide_.empty(); }

  /// A light path's start at a light that has been chosen; its flux is 0 where there is none.
  struct Start {
    Emission<float> emission;
    EmissionPdfs<float> pdfs;
    Vec2<float> uv;
    std::uint32_t triangle = 0;
    float crowding = 1;  ///< density of the position over that of an even one
  };
  Start start(std::uint32_t light, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// `u_choice` chooses the light in proportion to its flux.
  LightEmission emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Densities with which `emit` starts a photon of this light on the ray through p in `direction`, the light's choice
  /// not inside. `p`, `n`: of a surface light its point and normal there, of a mesh on that triangle; of others any
  /// point of the ray, and n is not used. Delta densities are given as 1.
  EmissionPdfs<float> emission_pdfs(std::uint32_t light, const Vec3f& p, const Vec3f& n, std::uint32_t triangle,
                                    const Vec3f& direction) const;
  /// The probability with which `emit` chooses this light.
  float emission_probability(std::uint32_t light) const;

  /// From a point with normal n (towards the emitting side) and texture coordinates uv of a surface light, in
  /// direction w; 0 from behind.
  Rgb emitted_radiance(std::uint32_t light, const Vec3f& n, const Vec2<float>& uv, const Vec3f& w) const;

  /// The light that rays see which leave the scene.
  std::optional<std::uint32_t> environment() const { return environment_; }
  /// From `direction`, unit, as seen from the scene; 0 without an environment.
  Rgb environment_radiance(const Vec3f& direction) const;
  /// The density per solid angle with which `sample` from p gives the environment in `direction`.
  float environment_pdf(const Vec3f& p, const Vec3f& direction) const;

  const Light& light(std::uint32_t index) const { return lights_[index]; }
  /// Whether these lights are so many that they are chosen by position.
  static bool wants_tree(const std::vector<Light>& lights);
  /// Whether lights are chosen by position.
  bool has_tree() const { return tree_ != nullptr; }
  static constexpr std::size_t most_in_table = 16;

 private:
  Choice choose_infinite(float u) const;

  const std::vector<Light>& lights_;
  const std::vector<LightWords>& words_;
  SceneBall ball_;
  EmissionGuide guide_;
  std::optional<std::uint32_t> environment_;
  std::vector<std::uint32_t> infinite_;  ///< with a tree, which holds the others
  float infinite_probability_ = 0;       ///< of all infinite lights together
  std::unique_ptr<LightTree> tree_;
};

}  // namespace photonproof
