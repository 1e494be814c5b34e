#include "renderer/photon_mapping/photon_dots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/core/ray_counts.h"
#include "renderer/lanes/draws.h"
#include "renderer/photons/photon_sheet.h"
#include "renderer/scalar/surroundings.h"
#include "renderer/scalar/world.h"
#include "renderer/scalar/world_camera.h"
#include "renderer/sensor/splats.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream photon_dots_stream{11};
constexpr std::uint32_t lens_dimension = 0, layer_dimension = 1;
constexpr std::size_t photons_a_unit = 4096;

/// Mean of the channels.
double brightness_of(const Rgb& flux) { return (double{flux.x} + double{flux.y} + double{flux.z}) / 3; }

/// What the mean of the photons is multiplied with to have the brightness 1.
float dot_scale(const Photons& photons) {
  double sum = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) sum += brightness_of(photons[i].flux);
  return sum > 0 ? static_cast<float>(static_cast<double>(photons.size()) / sum) : 0;
}

/// Of a unit of work.
struct SeenPhotons {
  Splats dots;
  RayCounts rays;
};

class PhotonEye {
 public:
  /// `hides_lamps`: the camera does not see photons on lamps, but those behind.
  PhotonEye(const Scene& scene, bool hides_lamps) : world_(scene), camera_(world_, 1), hides_lamps_(hides_lamps) {}

  /// Adds the photon's dot, of its flux times `scale`, if the camera sees the side it landed on.
  void look_at(const Photon& photon, float scale, const Draws& draws, SeenPhotons& seen) const {
    if (hides_lamps_ && world_.scene().surfaces[surface_number(photon.surface)].light != no_index) return;
    const std::optional<CameraSeen> camera = camera_.connect(photon.p_world, draws.two(lens_dimension));
    if (!camera) return;
    const Vec3f side = facing_sheet_normal(photon.sheet);
    if (!(dot(side, camera->wi) > 0)) return;
    ++seen.rays.shadow;
    const SegmentEnd landed{photon.p_world, side, no_index, surface_number(photon.surface)};
    const Passing through{.null = true, .lamps = hides_lamps_};
    const Rgb arrives = transmittance(world_, landed, camera->end, {}, through, draws, layer_dimension);
    if (max_component(arrives) > 0) seen.dots.push_back({camera->raster, photon.flux * arrives * scale});
  }

 private:
  World world_;
  WorldCamera camera_;
  bool hides_lamps_;
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
                    draws_of_history(source.job.sampler, source.job.seed, photon_dots_stream, stored_before + i), seen);
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
