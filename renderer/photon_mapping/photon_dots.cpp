#include "renderer/photon_mapping/photon_dots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/core/ray_counts.h"
#include "renderer/lanes/path_sampler.h"
#include "renderer/photons/surface_side.h"
#include "renderer/scalar/scalar_camera.h"
#include "renderer/scalar/scene_interface.h"
#include "renderer/scalar/surroundings.h"
#include "renderer/sensor/splats.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream photon_dots_stream{11};
constexpr std::uint32_t lens_dimension = 0, layer_dimension = 1;
constexpr std::size_t photons_a_unit = 4096;

/// Mean of the channels.
double brightness_of(const Rgb& flux) { return (double{flux.x} + double{flux.y} + double{flux.z}) / 3; }

/// Factor that gives the photons' mean flux the brightness 1.
float dot_scale(const Photons& photons) {
  double sum = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) sum += brightness_of(photons[i].flux);
  return sum > 0 ? static_cast<float>(static_cast<double>(photons.size()) / sum) : 0;
}

/// Dots and rays of a unit of work.
struct SeenPhotons {
  Splats dots;
  RayCounts rays;
};

class PhotonEye {
 public:
  /// With `hides_lights` the camera does not see photons on lights, but those behind.
  PhotonEye(const Scene& scene, bool hides_lights)
      : scene_interface_(scene), camera_(scene_interface_, 1), hides_lights_(hides_lights) {}

  /// Adds the photon's dot, of its flux times `scale`, if the camera sees the side it landed on.
  void look_at(const Photon& photon, float scale, const PathSampler& draws, SeenPhotons& seen) const {
    if (hides_lights_ && scene_interface_.scene().surfaces[surface_number(photon.surface)].light != no_index) return;
    const std::optional<CameraSeen> camera = camera_.connect(photon.p_world, draws.two(lens_dimension));
    if (!camera) return;
    const Vec3f side = facing_side_normal(photon.surface_side);
    if (!(dot(side, camera->wi) > 0)) return;
    ++seen.rays.shadow;
    const SegmentEnd landed{photon.p_world, side, no_index, surface_number(photon.surface)};
    const Passing through{.null = true, .lights = hides_lights_};
    const Rgb arrives = transmittance(scene_interface_, landed, camera->end, {}, through, draws, layer_dimension);
    if (max_component(arrives) > 0) seen.dots.push_back({camera->raster, photon.flux * arrives * scale});
  }

 private:
  SceneInterface scene_interface_;
  ScalarCamera camera_;
  bool hides_lights_;
};

void add_dots(const Splats& dots, const Tile& window, SplatImage& sums) {
  for (const Splat& dot : dots) {
    const int x = static_cast<int>(std::floor(dot.raster.x)), y = static_cast<int>(std::floor(dot.raster.y));
    if (window.contains(x, y)) sums.add(x, y, RgbD(dot.value));
  }
}

}  // namespace

void render_photon_dots(const PhotonSource& source, PhotonMaps& maps, const PassPlan& passes, Film& film,
                        RenderStats& stats) {
  const Tile window = film.window();
  const PhotonEye eye(source.scene, source.settings.limits.hide_emitters);
  SplatImage sums(window, source.scene.filter);
  std::int64_t pass_count = 0;
  RenderLoop loop(source.job, source.threads, film, stats, passes);
  loop.keep(sums.sums());
  loop.keep_between_passes(pass_count);
  for (MapState* map : {&maps.global, &maps.caustic}) loop.keep_between_passes(map->counts);
  std::vector<SeenPhotons> slots(loop.slots());
  while (loop.next()) {
    const std::uint64_t stored_before = maps.global.counts.stored + maps.caustic.counts.stored;
    Photons photons;
    for (MapState* map : maps.wanted())
      photons.append(emit_photons(*map, source, loop.first(), loop.first() + loop.samples(), stats));
    const float scale = dot_scale(photons);
    const std::size_t units = photons.size() / photons_a_unit + 1;
    const auto work_on = [&](std::size_t unit, std::size_t slot) {
      SeenPhotons& seen = slots[slot];
      seen = {};
      const std::size_t end = std::min(photons.size(), (unit + 1) * photons_a_unit);
      for (std::size_t i = unit * photons_a_unit; i < end; ++i)
        eye.look_at(photons[i], scale,
                    sampler_of_path(source.job.sampler, source.job.seed, photon_dots_stream, stored_before + i), seen);
      loop.rays().add(seen.rays);
    };
    const auto commit = [&](std::size_t unit, std::size_t slot) {
      add_dots(slots[slot].dots, window, sums);
      if (unit + 1 < units) return;
      const auto samples = static_cast<double>(loop.samples());
      for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x) film.add(x, y, sums.sum(x, y) / samples, samples);
      film.end_shared_pass(samples);
      sums.clear();
    };
    const PhaseTimer phase(stats.phases["render"]);
    loop.for_each_in_order(units, work_on, commit);
    if (!loop.broken_off()) ++pass_count;
  }
  maps.store_counts(source.scene, pass_count, stats);
}

}  // namespace photonproof::inline renderer_photon_mapping
