// All lights of a scene: which one, a point of it, a light path's start, and the densities of those. Scalar integrators
// ask here; kernels do for lights that need tables, for choices by position and for guided starts, and draw the rest by
// the same formulas in their lanes (kernels/lights.h).
//
// Kinds of light, and what `radiance` and the densities mean for them:
//   surface      (rectangle, sphere, disk, cylinder, mesh)  radiance, W m^-2 sr^-1; position density per area
//   point-like   (point, spot, ies)   intensity, W sr^-1; the position is a delta: density 1
//   environment  (constant, envmap, sunsky)  radiance; no position of its own, see below
//   directional  irradiance on a surface that faces it, W m^-2; the direction is a delta: density 1
//
// Emission. A surface light's photon starts at a point with a density per area and leaves with one per solid angle. An
// infinite light's direction of travel is drawn first; then the point where it enters, uniformly on the disc across
// that direction that covers the ball around the scene: 1 / (pi radius^2) per area across the direction. EmissionPdfs
// are in that order. What a photon carries is in every case
//   flux = radiance |cos| / (pdfs.first pdfs.second), divided by the probability of the light,
// where |cos| is that of the emission's normal, 1 without one: infinite lights count as the disc, facing the scene.
// A bidirectional estimator's density of the first vertex on a surface y met by the photon is then
//   finite lights     pdfs.second |cos_y| / distance^2 per area
//   infinite lights   pdfs.second |cos_y| per area, and pdfs.first takes the place of the light vertex's own density
//
// The ball holds all shapes but infinite planes, which emission of infinite lights does not cover outside of it:
// emit_pdfs are 0 there, so that weights of multiple importance sampling hold.
//
// Densities are of a light that has been chosen where the name ends in _of; else the choice is inside.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/light_sampling/emission_guiding.h"
#include "renderer/light_sampling/light_sampling.h"
#include "renderer/light_sampling/light_words.h"
#include "renderer/lights/light.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_lights {
class LightTree;
}

namespace photonproof::inline renderer_light_sampling {

/// A light as seen from a point; pdf is 0 where it shows nothing.
struct LightSeen : LightSample<float> {
  std::uint32_t light = no_index;
  bool is_delta = false;  ///< no ray finds it: sampling it is the only strategy
  bool is_infinite = false;
};

/// A light path's start; its flux is 0 where there is none.
struct LightStart : Emission<float> {
  EmissionPdfs<float> pdfs;
  std::uint32_t light = no_index;
  bool is_delta = false, is_infinite = false;
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
  bool is_delta(std::uint32_t light) const;
  bool is_infinite(std::uint32_t light) const;

  /// Chooses a light for the reference point p; its probability is 0 where none could shine.
  LightSampling<float> choose(const Vec3f& p, float u) const;
  float choice_probability(const Vec3f& p, std::uint32_t light) const;
  LightSeen sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const;
  /// Chooses a light, and a point or direction of it. pdf: of a delta light the probability of its choice.
  LightSeen sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const;
  /// The density with which sampling from p gives that point, per solid angle; 0 of a delta light.
  float pdf_of(std::uint32_t light, const Vec3f& p, const LightPoint<float>& at) const;
  float pdf(std::uint32_t light, const Vec3f& p, const LightPoint<float>& at) const;
  /// The same for a light path's start, or where it came from; of a delta light the probability of its choice.
  float pdf(const Vec3f& p, const LightStart& start) const;

  /// Light paths start where what the camera sees gets its light from (emission_guiding.h), from now on.
  void guide_emission(EmissionGuiding guide) { guide_ = std::move(guide); }
  bool has_guide() const { return !guide_.empty(); }

  LightStart start_of(std::uint32_t light, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Chooses the light in proportion to its flux. The choice is in the flux and in pdfs.first.
  LightStart emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Densities with which a photon of this light starts at its point `at` in `direction`. `on_line` is any point of
  /// that ray, best one that it is to meet: from far away directions do not say exactly enough where it goes. Of light
  /// from infinity `at` is not looked at.
  EmissionPdfs<float> emit_pdfs_of(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction,
                                   const Vec3f& on_line) const;
  EmissionPdfs<float> emit_pdfs(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction,
                                const Vec3f& on_line) const;
  EmissionPdfs<float> emit_pdfs(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const {
    return emit_pdfs(light, at, direction, at.p);
  }
  /// The probability with which `emit` chooses this light.
  float emission_probability(std::uint32_t light) const { return words_[light].probability; }
  /// What a photon that starts there evenly carries towards `direction`, W sr^-1 (light_kinds.h).
  Rgb flux_towards(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const;

  /// From a point of a light, with its texture coordinates, in `direction`; 0 from behind.
  Rgb radiance(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const;
  /// A point that a ray met, with its texture coordinates.
  LightPoint<float> with_uv(std::uint32_t light, const LightPoint<float>& at) const;

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
  LightSampling<float> chosen(std::uint32_t light, float probability) const;
  LightSampling<float> choose_infinite(float u) const;

  const std::vector<Light>& lights_;
  const std::vector<LightWords>& words_;
  SceneBall ball_;
  EmissionGuiding guide_;
  std::optional<std::uint32_t> environment_;
  std::vector<std::uint32_t> infinite_;  ///< with a tree, which holds the others
  float infinite_probability_ = 0;       ///< of all infinite lights together
  std::unique_ptr<LightTree> tree_;
};

/// Whether light from infinity falls on a plane without end: light paths do not reach it outside of the ball.
bool emission_misses_planes(const std::vector<Surface>& surfaces, const std::vector<Light>& lights);

}  // namespace photonproof::inline renderer_light_sampling
