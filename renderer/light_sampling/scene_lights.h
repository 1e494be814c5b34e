// All lights of a scene: choice of a light, a point on it, a light path's start, and their densities. Scalar
// integrators use this class. Kernels use it for lights that need tables, for choices by position and for guided
// starts. For the rest they apply the same formulas in their lanes (kernels/lights.h).
//
// Meaning of `radiance` and of the densities for each kind of light.
//   Surface (rectangle, sphere, disk, cylinder, mesh): radiance, W m^-2 sr^-1; position density per area.
//   Point-like (point, spot, ies): intensity, W sr^-1; the position is a delta: density 1.
//   Environment (constant, envmap, sunsky): radiance; no position of its own, see below.
//   Directional: irradiance on a surface that faces it, W m^-2; the direction is a delta: density 1.
//
// Emission. A surface light's photon starts at a point with a density per area and leaves with one per solid angle. For
// an infinite light the direction of travel is sampled first. Then follows the point of entry, uniform on the disc
// across that direction that covers the ball around the scene. Its density is 1 / (pi radius^2) per area across the
// direction. EmissionPdfs are in that order. A photon of any light carries
//   `flux = radiance |cos| / (pdfs.first pdfs.second)`, divided by the probability of the light.
// The cosine is that of the emission's normal, 1 without one: infinite lights count as the disc, facing the scene. A
// bidirectional estimator needs the density of the first vertex on a surface y that the photon meets.
//   Finite lights: `pdfs.second |cos_y| / distance^2` per area.
//   Infinite lights: `pdfs.second |cos_y|` per area, and pdfs.first replaces the light vertex's own density.
//
// The ball holds all shapes except infinite planes. Emission of infinite lights does not cover these planes outside the
// ball: emit_pdfs are 0 there, so that weights of multiple importance sampling hold.
//
// Functions whose name ends in _of give densities for a chosen light; all others include the choice.
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

/// A light as seen from a point; pdf is 0 where no light arrives.
struct LightSeen : LightSample<float> {
  std::uint32_t light = no_index;
  bool is_delta = false;  ///< no ray finds it: sampling it is the only strategy
  bool is_infinite = false;
};

/// A light path's start; its flux is 0 where none exists.
struct LightStart : Emission<float> {
  EmissionPdfs<float> pdfs;
  std::uint32_t light = no_index;
  bool is_delta = false, is_infinite = false, is_outside = false;
};

class SceneLights {
 public:
  /// The `words` are the scene's light_table. More than `most_in_table` finite lights are chosen by position
  /// (light_tree.h), unless `by_position` is false. Arguments must outlive this object.
  SceneLights(const std::vector<Light>& lights, const std::vector<LightWords>& words, const SceneBall& ball,
              bool by_position = true);
  ~SceneLights();
  SceneLights(const SceneLights&) = delete;
  SceneLights& operator=(const SceneLights&) = delete;

  std::size_t count() const { return lights_.size(); }
  const SceneBall& ball() const { return ball_; }
  bool is_delta(std::uint32_t light) const;
  bool is_infinite(std::uint32_t light) const;
  bool is_outside(std::uint32_t light) const;

  /// Chooses a light for the reference point p; the probability is 0 where none can shine.
  LightSampling<float> choose(const Vec3f& p, float u) const;
  float choice_probability(const Vec3f& p, std::uint32_t light) const;
  LightSeen sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const;
  /// Chooses a light, and a point or direction of it. For a delta light, pdf is the probability of its choice.
  LightSeen sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const;
  /// Density per solid angle with which sampling from p gives that point; 0 for a delta light.
  float pdf_of(std::uint32_t light, const Vec3f& p, const LightPoint<float>& at) const;
  float pdf(std::uint32_t light, const Vec3f& p, const LightPoint<float>& at) const;
  /// The same for a light path's start or origin; for a delta light the probability of its choice.
  float pdf(const Vec3f& p, const LightStart& start) const;

  /// From now on light paths start where the visible scene gets its light from (emission_guiding.h).
  void guide_emission(EmissionGuiding guide) { guide_ = std::move(guide); }
  bool has_guide() const { return !guide_.empty(); }

  LightStart start_of(std::uint32_t light, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Chooses the light in proportion to its flux. The flux and pdfs.first include the choice.
  LightStart emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Densities with which a photon of this light starts at its point `at` in `direction`. `on_line` is any point of
  /// that ray, preferably one that it meets: from far away, directions are not exact enough. For light from infinity
  /// `at` is not used.
  EmissionPdfs<float> emit_pdfs_of(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction,
                                   const Vec3f& on_line) const;
  EmissionPdfs<float> emit_pdfs(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction,
                                const Vec3f& on_line) const;
  EmissionPdfs<float> emit_pdfs(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const {
    return emit_pdfs(light, at, direction, at.p);
  }
  /// Probability with which `emit` chooses this light.
  float emission_probability(std::uint32_t light) const { return words_[light].probability; }
  /// Flux of an even photon start there towards `direction`, W sr^-1 (flux_towards in light_kinds.h).
  Rgb flux_towards(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const;

  /// Radiance from a point of a light, with its texture coordinates, in `direction`; 0 from behind.
  Rgb radiance(std::uint32_t light, const LightPoint<float>& at, const Vec3f& direction) const;
  /// A point that a ray met, completed by its texture coordinates.
  LightPoint<float> with_uv(std::uint32_t light, const LightPoint<float>& at) const;

  /// The light seen by rays that leave the scene.
  std::optional<std::uint32_t> environment() const { return environment_; }
  /// Radiance from the unit `direction`, as seen from the scene; 0 without an environment.
  Rgb environment_radiance(const Vec3f& direction) const;
  /// Density per solid angle with which `sample` from p gives the environment in `direction`.
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
  std::vector<std::uint32_t> infinite_;  ///< used with a tree, which holds the others
  float infinite_probability_ = 0;       ///< sum over all infinite lights
  std::unique_ptr<LightTree> tree_;
};

/// Whether light from infinity falls on an infinite plane: light paths do not reach it outside the ball.
bool emission_misses_planes(const std::vector<Surface>& surfaces, const std::vector<Light>& lights);

}  // namespace photonproof::inline renderer_light_sampling
