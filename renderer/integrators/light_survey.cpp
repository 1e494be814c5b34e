// Camera paths with light sampling at every vertex find the routes of most light. The exception is light from a source
// without size that first meets a delta. Light paths connected to the camera find that too, where the camera sees a
// scattering vertex. Where such a vertex is seen in a mirror or through glass, neither works. There a cell of space
// collects the light that light paths leave in it. That light is taken as spread over the cell's face and seen by the
// camera paths that arrive by deltas alone. A route's light adds to the loss of every integrator that cannot find it
// (light_routes.h).

#include "renderer/integrators/light_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "renderer/lanes/roulette.h"
#include "renderer/planning/light_routes.h"
#include "renderer/scalar/scalar_tracer.h"

namespace photonproof::inline renderer_integrators {
namespace {

constexpr Stream survey_camera_stream{22}, survey_light_stream{23};

/// Number of paths from each end.
constexpr std::uint64_t survey_paths = 4096;
/// Limits for paths that are long because hardly any light is absorbed.
constexpr std::uint32_t most_edges = 256, roulette_from = 4;
/// Share of the image's light. A smaller loss is below the resolution of bounds and references, and needs no warning.
constexpr double least_share = 5e-4;
/// Longest run of scattering turns that is recorded: a third in a row makes no difference to any integrator.
constexpr char twice[] = {turn::scatters, turn::scatters, 0};
/// Number of cells along the radius of the scene's ball.
constexpr float cells_a_radius = 16;

namespace survey_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1, light = 2, position = 3, direction = 4;
constexpr std::uint32_t first_vertex = 8, of_vertex = 6, segment = 0x80000000u;
enum What : std::uint32_t { layer, lobe, next, light_sampling, light_point, roulette };
constexpr std::uint32_t at_vertex(std::uint32_t edges, What what) { return first_vertex + edges * of_vertex + what; }
}  // namespace survey_dimension

double brightness(const Rgb& v) { return (double{v.x} + double{v.y} + double{v.z}) / 3; }

/// Share of the scattering at a vertex along `wo`, from `wi`, for which photons are gathered.
double looked_up_share(const Interaction& at, const Vec3f& wo, const Vec3f& wi, const RoughLimit& limit) {
  const Vec3f wo_local = at.scattering.frame.to_local(wo), wi_local = at.scattering.frame.to_local(wi);
  return std::visit(
      [&]<class Record>(const Record& bsdf) -> double {
        if constexpr (CanBeRough<Record, float>)
          return bsdf.is_rough(limit) ? brightness(bsdf.rough_share(limit, wo_local, wi_local)) : 0;
        else
          return Record::is_lambertian ? 1 : 0;
      },
      at.bsdf);
}

class LightSurvey : ScalarTracer {
 public:
  LightSurvey(const Scene& scene, const PathLimits& limits)
      : ScalarTracer(scene, limits, std::int64_t{scene.width} * scene.height),
        cell_(lights_->ball().radius / cells_a_radius) {
    scatters_in_media_ =
        std::ranges::any_of(scene.media.media, [](const Medium& m) { return m.scatters || m.varying; });
  }

  /// Traces all paths and adds their contributions.
  void run() {
    for (std::uint64_t i = 0; i < survey_paths; ++i) {
      if (!scatters_in_media_) trace_from_camera(sampler_of_path(SamplerKind::sobol, 0, survey_camera_stream, i));
      if (lights_->count() > 0) trace_from_light(sampler_of_path(SamplerKind::sobol, 0, survey_light_stream, i));
    }
    add_what_is_seen_of_cells();
  }

  /// Lost share of all light; empty where there is no light.
  std::optional<double> share_lost_by(const LightFinder& finder) const {
    if (!(whole_ > 0)) return std::nullopt;
    return lost_[static_cast<std::size_t>(&finder - light_finders().data())] / whole_;
  }
  bool scatters_in_media() const { return scatters_in_media_; }

 private:
  using Cell = std::array<std::int64_t, 4>;
  /// Light that light paths leave in a cell, and weight with which camera paths arrive there, both by deltas alone.
  struct Meeting {
    struct {
      double thrown = 0, seen = 0;
    } bent{}, straight{};  ///< with and without a mirror or glass on the way
  };

  void add(bool from_point, const std::string& from_light, double light) {
    if (!std::isfinite(light) || !(light > 0)) return;
    whole_ += light;
    add_to_lost({from_point, from_light}, light);
  }
  void add_to_lost(const LightRoute& route, double light) {
    for (std::size_t i = 0; i < lost_.size(); ++i)
      if (!light_finders()[i].finds(route)) lost_[i] += light;
  }

  /// Adds a turn between two directions: one share by the part that photons are gathered for, the other by the rest.
  void add_turn(bool from_point, const std::string& before, const std::string& behind, double looked_up, double light) {
    add(from_point, before + turn::scatters + behind, light * looked_up);
    add(from_point, before + turn::glitters + behind, light * (1 - looked_up));
  }

  Cell cell_at(const Interaction& at) const {
    const auto along = [&](float x) { return static_cast<std::int64_t>(std::floor(double{x} / double{cell_})); };
    return {along(at.p.x), along(at.p.y), along(at.p.z), at.surface};
  }

  char turn_of(const Interaction& at, const Scattered& next, const Vec3f& wo) const {
    if (next.straight) return turn::goes_straight;
    if (next.delta) return turn::is_thrown;
    return looked_up_share(at, wo, next.wi, scene_interface_.view().rough_limit) > 0.5 ? turn::scatters
                                                                                       : turn::glitters;
  }

  /// Roulette; false where it ends the path.
  static bool goes_on(const PathSampler& draws, std::uint32_t edges, float first, Rgb& throughput) {
    if (!(max_component(throughput) > 0)) return false;
    if (edges < roulette_from) return true;
    const float q = std::min(0.95f, max_component(throughput) / first);
    if (draws.one(survey_dimension::at_vertex(edges, survey_dimension::roulette)) >= q) return false;
    throughput *= 1 / q;
    return true;
  }

  Rgb arriving(const Interaction& at, const Vec3f& back, const SegmentEnd& to, Surroundings around,
               const PathSampler& draws) const {
    around.leave(scene_interface_, at, back, to.p - at.p);
    return transmittance(scene_interface_, end_at(at), to, around, {}, draws, survey_dimension::segment);
  }

  void trace_from_camera(const PathSampler& draws) {
    const int width = scene_interface_.scene().width, height = scene_interface_.scene().height;
    const Vec2<float> place = draws.two(survey_dimension::light);
    const int x = std::min(width - 1, static_cast<int>(place.x * static_cast<float>(width)));
    const int y = std::min(height - 1, static_cast<int>(place.y * static_cast<float>(height)));
    std::optional<Ray> ray = camera_.ray(x, y, draws, 0, survey_dimension::in_pixel, draws.two(survey_dimension::lens));
    if (!ray) return;
    Rgb throughput(1.0f);
    Surroundings around = around_camera_;
    bool sampled = false;   // whether light sampling at the previous vertex also finds this light
    bool by_deltas = true;  // only deltas so far
    std::string turns;      // from the light on
    for (std::uint32_t edges = 1; within(edges) && edges <= most_edges; ++edges) {
      const auto draw = [&](survey_dimension::What what) { return survey_dimension::at_vertex(edges, what); };
      Interaction at;
      if (!travel(scene_interface_, *ray, around, draws.one(draw(survey_dimension::layer)), TransportMode::radiance,
                  throughput, at) ||
          (edges == 1 && camera_.beyond_far_plane(at.p))) {
        if (!sampled && shows_lights(edges))
          add(false, turns, brightness(throughput * lights_->environment_radiance(ray->direction)));
        return;
      }
      const Vec3f wo = -ray->direction;
      if (at.light != no_index && !sampled && shows_lights(edges))
        add(false, turns, brightness(throughput * lights_->radiance(at.light, lights_.point(at), wo)));
      if (!within(edges + 1)) return;
      if (has_smooth(at.bsdf)) {
        if (by_deltas && !turns.empty()) {
          Meeting& here = meetings_[cell_at(at)];
          (is_bent(turns) ? here.bent : here.straight).seen += brightness(throughput);
        }
        add_direct_light(at, wo, throughput, around, turns, draws, edges);
      }
      const Scattered next = scatter(at, wo, draws.one(draw(survey_dimension::lobe)),
                                     draws.two(draw(survey_dimension::next)), TransportMode::radiance);
      if (!next.valid) return;
      throughput *= next.weight;
      if (!goes_on(draws, edges, 1, throughput)) return;
      if (const char t = turn_of(at, next, wo); t != turn::scatters || !turns.starts_with(twice))
        turns.insert(turns.begin(), t);
      sampled = !next.delta;
      by_deltas = by_deltas && next.delta;
      around.leave(scene_interface_, at, wo, next.wi);
      ray = scene_interface_.leave(at, next.wi);
    }
  }

  void add_direct_light(const Interaction& at, const Vec3f& wo, const Rgb& throughput, const Surroundings& around,
                        const std::string& turns, const PathSampler& draws, std::uint32_t edges) {
    const LightSeen seen =
        lights_->sample(at.p, draws.one(survey_dimension::at_vertex(edges, survey_dimension::light_sampling)),
                        draws.two(survey_dimension::at_vertex(edges, survey_dimension::light_point)));
    if (!(seen.pdf > 0)) return;
    const Rgb value = throughput * evaluate(at, wo, seen.wi, TransportMode::radiance) * seen.radiance * (1 / seen.pdf);
    if (!(max_component(value) > 0)) return;
    add_turn(seen.is_delta, "", turns, looked_up_share(at, wo, seen.wi, scene_interface_.view().rough_limit),
             brightness(value * arriving(at, wo, lights_.end(seen), around, draws)));
  }

  /// Traces a path from a light without size, if its first surface is a delta.
  void trace_from_light(const PathSampler& draws) {
    const LightStart start = lights_->emit(draws.one(survey_dimension::light), draws.two(survey_dimension::position),
                                           draws.two(survey_dimension::direction));
    Rgb throughput = start.flux * arriving_from_infinity(scene_interface_, start.is_outside, outer_);
    if (scatters_in_media_) whole_ += brightness(start.flux);
    if (!start.is_delta || !(max_component(throughput) > 0)) return;
    const float first = max_component(throughput);
    Ray ray = first_ray(start);
    Surroundings around = surroundings_at(scene_interface_, start.at.p, outer_);
    std::string turns;
    for (std::uint32_t edges = 1; within(edges + 1) && edges <= most_edges; ++edges) {
      const auto draw = [&](survey_dimension::What what) { return survey_dimension::at_vertex(edges, what); };
      if (is_bent(turns) && is_in_fog(around)) return add_to_fog(turns, throughput);
      Interaction at;
      if (!travel(scene_interface_, ray, around, draws.one(draw(survey_dimension::layer)), TransportMode::importance,
                  throughput, at))
        return;
      const Vec3f to_light = -ray.direction;
      if (!turns.empty() && has_smooth(at.bsdf)) {
        if (scatters_in_media_) return add_to_fog(turns, throughput);
        if (turns.find_first_of({turn::scatters, turn::glitters}) == std::string::npos) {
          Meeting& here = meetings_[cell_at(at)];
          (is_bent(turns) ? here.bent : here.straight).thrown += brightness(throughput);
        }
        join_camera(at, to_light, throughput, around, turns, draws, edges);
      }
      const Scattered next = scatter(at, to_light, draws.one(draw(survey_dimension::lobe)),
                                     draws.two(draw(survey_dimension::next)), TransportMode::importance);
      if (!next.valid || (turns.empty() && !next.delta)) return;
      throughput *= next.weight;
      if (!goes_on(draws, edges, first, throughput)) return;
      if (const char t = turn_of(at, next, to_light); t != turn::scatters || !turns.ends_with(twice)) turns += t;
      around.leave(scene_interface_, at, to_light, next.wi);
      ray = scene_interface_.leave(at, next.wi);
    }
  }

  bool shows_lights(std::uint32_t edges) const { return edges > 1 || !limits_.hide_emitters; }
  static bool is_bent(const std::string& turns) { return turns.find(turn::is_thrown) != std::string::npos; }
  bool is_in_fog(const Surroundings& around) const {
    if (around.medium() == no_index) return false;
    const Medium& medium = scene_interface_.scene().media.media[around.medium()];
    return medium.scatters || medium.varying;
  }
  /// In scattering media all light that arrives anywhere counts as lost: the share seen by the camera is unknown.
  void add_to_fog(const std::string& turns, const Rgb& throughput) {
    add_to_lost({true, turns + turn::scatters}, brightness(throughput));
  }

  void join_camera(const Interaction& at, const Vec3f& to_light, const Rgb& throughput, const Surroundings& around,
                   const std::string& turns, const PathSampler& draws, std::uint32_t edges) {
    const std::optional<CameraSeen> seen =
        camera_.connect(at.p, draws.two(survey_dimension::at_vertex(edges, survey_dimension::light_point)));
    if (!seen) return;
    Interaction other;
    const Interaction& from_there = scene_interface_.seen_from(at, seen->wi, other);
    const Rgb value = throughput * evaluate(from_there, seen->wi, to_light, TransportMode::importance) * seen->density;
    if (!(max_component(value) > 0)) return;
    add_turn(true, turns, "", looked_up_share(from_there, seen->wi, to_light, scene_interface_.view().rough_limit),
             brightness(value * arriving(at, to_light, seen->end, around, draws)));
  }

  void add_what_is_seen_of_cells() {
    constexpr double grey = 0.5;
    const double of_flux = grey / (double{pi} * double{cell_} * double{cell_} * static_cast<double>(survey_paths));
    for (const auto& [cell, at] : meetings_)
      for (const auto& [thrown, first] :
           {std::pair{at.bent.thrown, turn::is_thrown}, {at.straight.thrown, turn::goes_straight}})
        for (const auto& [seen, last] :
             {std::pair{at.bent.seen, turn::is_thrown}, {at.straight.seen, turn::goes_straight}})
          add(true, {first, turn::scatters, last}, seen * thrown * of_flux);
  }

  float cell_;
  bool scatters_in_media_ = false;
  double whole_ = 0;                                                        ///< sum over paths
  std::vector<double> lost_ = std::vector<double>(light_finders().size());  ///< light lost to each of them
  std::map<Cell, Meeting> meetings_;
};

const LightFinder* finder_named(const std::string& integrator) {
  const auto found = std::ranges::find(light_finders(), integrator, &LightFinder::integrator);
  return found != light_finders().end() ? &*found : nullptr;
}

}  // namespace

bool may_lose_light(const SceneFacts& facts, const std::string& integrator) {
  const LightFinder* finder = finder_named(integrator);
  return finder != nullptr && facts.lights > 0 && facts.primitives > 0 &&
         (!finder->needs_point || facts.any_delta_light) && (!finder->needs_delta || facts.any_delta_lobe);
}

std::optional<LostLight> light_lost_by(const std::string& integrator, const Scene& scene, const PathLimits& limits) {
  const LightFinder* finder = finder_named(integrator);
  if (finder == nullptr) return std::nullopt;
  LightSurvey survey(scene, limits);
  survey.run();
  const std::optional<double> share = survey.share_lost_by(*finder);
  if (!share || *share < least_share) return std::nullopt;
  LostLight lost{integrator, std::string(finder->misses), survey.scatters_in_media() ? 0 : *share};
  for (const LightFinder& other : light_finders())
    if (survey.share_lost_by(other).value_or(0) < least_share) lost.finders.emplace_back(other.integrator);
  return lost;
}

}  // namespace photonproof::inline renderer_integrators
