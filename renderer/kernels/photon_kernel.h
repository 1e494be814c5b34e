// Photons from the lights through the scene (Jensen 2001, chapters 5 and 7.2), over a batch of lanes. They are stored
// on Lambertian surfaces. All other surfaces, rough ones too, count as specular, since camera paths continue from there
// as well. Their rough parts store caustic photons that no rough part has scattered, with directions (rough_gather.h).
#pragma once

#include "renderer/kernels/batch_kernel.h"
#include "renderer/kernels/lights.h"
#include "renderer/kernels/projection_map.h"
#include "renderer/kernels/tasks.h"
#include "renderer/lanes/roulette.h"
#include "renderer/lanes/warp.h"
#include "renderer/photons/rough_photon.h"
#include "renderer/rays/rays.h"

namespace photonproof::inline renderer_kernels {

template <class F>
struct PhotonState {
  Vec3<F> origin, direction;
  Vec3<F> flux;     ///< W
  F weight;         ///< Largest channel of the flux relative to the start, for roulette.
  UInt<F> from;     ///< Primitive that the ray leaves.
  UInt<F> edges;    ///< Edges before the next ray.
  UInt<F> bounced;  ///< PhotonKernel's bits.
  UInt<F> path;     ///< Number in the task.

  static constexpr std::size_t column_count = 14;
  template <class Self, class Visit>
  static void columns(Self& s, Visit&& visit) {
    const auto visit3 = [&](auto& v) { visit(v.x), visit(v.y), visit(v.z); };
    visit3(s.origin), visit3(s.direction), visit3(s.flux);
    visit(s.weight);
    visit(s.from), visit(s.edges), visit(s.bounced), visit(s.path);
  }
};

template <class F>
class PhotonKernel : public BatchKernel<PhotonKernel<F>, BatchQueues<PhotonState, TransportMode::importance, F>> {
  using Base = BatchKernel<PhotonKernel<F>, BatchQueues<PhotonState, TransportMode::importance, F>>;
  using U = UInt<F>;
  static constexpr std::uint32_t diffusely = 1, specularly = 2, roughly = 4;  // in PhotonState::bounced
  static constexpr std::uint32_t emission_dimensions = 3;                     // position, direction, light
  static constexpr std::uint32_t dimensions_an_edge = 3;                      // direction, lobe, roulette
  static constexpr std::uint32_t surface_dimensions = 1u << 24;               // one an edge: which of a surface's BSDFs
  /// From this many edges on, photons are stored less and less often, and carry more. Of k edges about
  /// 32 (1 + log(k/32)) are stored, so that maps of scenes with little absorption stay small.
  static constexpr float every_edge_until = 32;
  static constexpr std::uint32_t thinning_dimensions = 2u << 24;  // one an edge
  static constexpr std::uint32_t part_dimensions = 3u << 24;      // one an edge: which part of a BSDF scatters

 public:
  explicit PhotonKernel(PhotonTask& task) : Base(*task.scene, task.scratch), task_(task) {}

  [[gnu::flatten]] Mask<F> refill(PhotonState<F>& s, std::uint32_t first, const Mask<F>& lanes) {
    s.path = lane_index<F>() + first;
    F u_light(0.0f);
    if (!scene_.one_light) u_light = draw(s, 2u).x;
    const LightSampling<F> choice = choose_light(scene_, u_light);
    const Vec2<F> u_position = draw(s, 0u);
    const Vec2<F> u_direction = draw(s, 1u);
    Emission<F> start{};
    const auto shine = [&](const auto& light, const Mask<F>& of_kind) {
      start = select(of_kind, emit(s, light, choice.light, u_position, u_direction, of_kind), start);
    };
    if (scene_.guided_emission)
      shine(GeneralLight<F>(*scene_.general_lights, choice.light, lanes), lanes);
    else
      for_each_light_kind<F>(scene_, choice.light, lanes, shine);
    // A primitive in a small scene, the light's face elsewhere.
    const Mask<F> ahead = start.is_ahead > 0;
    s.from =
        select(ahead || equal<F>(choice.primitive, U(no_index)), U(no_index), choice.primitive + start.at.triangle);
    s.flux = start.flux;
    s.direction = start.direction;
    s.flux *= F(task_.share) / choice.probability;
    s.origin =
        select(ahead, start.ahead, offset_from(start.at.p, start.at.normal, s.direction, scene_.coordinate_floor));
    s.weight = F(1.0f);
    s.edges = U(0u);
    s.bounced = U(0u);
    return lanes && max_component(s.flux) > 0;
  }

  [[gnu::flatten]] void meet_surfaces(PhotonState<F>& s, const Mask<F>& active) {
    task_.counts.photon += count_lanes(active);
    const SurfaceHit<F> hit = closest_hit(scene_, s.origin, s.direction, s.from, active, false);
    if (!any(hit.valid)) return;
    s.from = hit.primitive;
    s.edges += 1u;
    Base::wait({s, hit.p, hit.normal, hit.surface}, hit.valid, [&] {
      return draw_independent<F>(U(task_.seed), U(s.path + task_.first), U(s.edges + surface_dimensions));
    });
  }

  template <template <class> class Kind>
  [[gnu::flatten]] void shade(AtSurface<PhotonState, F>& at, const Mask<F>& active) {
    PhotonState<F>& s = at.path_state;
    const ScatteringBsdf<Kind<F>, F> bsdf = Base::template scattering_at<Kind>(at, active);
    const Frame<F>& frame = bsdf.at.frame;
    const Vec3<F> wo_local = frame.to_local(Vec3<F>(-s.direction));
    if constexpr (!Kind<F>::is_lambertian) {
      if constexpr (CanBeRough<Kind<F>, F>)
        if (task_.kind == PhotonKind::caustic) store_on_rough(at, bsdf.bsdf, active && wo_local.z > 0);
      s.bounced |= U(specularly);
    } else {
      const std::uint32_t wanted = task_.kind == PhotonKind::global ? diffusely : specularly;
      const Vec3<F> flux = s.flux;
      if (bsdf.at.bent) s.flux *= bsdf.at.landing(wo_local);
      store(at, active && wo_local.z > 0 && max_component(s.flux) > 0 && !equal<F>(U(s.bounced & wanted), U(0u)),
            [&](const Vec3<F>& stored) {
              return Landed{at.p.x,   at.p.y,   at.p.z,     stored.x,
                            stored.y, stored.z, at.surface, side_word<F>(at.normal, frame.n)};
            });
      s.flux = flux;
      if (task_.kind == PhotonKind::caustic) return;
      s.bounced |= U(diffusely);
    }
    Mask<F> alive = active;
    if (task_.max_edges >= 0) alive = alive && as_mask<F>(s.edges < U(static_cast<std::uint32_t>(task_.max_edges)));
    if (!any(alive)) return;

    const U dimension = s.edges * dimensions_an_edge + emission_dimensions;
    Vec2<F> u_direction{F(0.0f), F(0.0f)};
    if constexpr (Kind<F>::has_smooth) u_direction = draw(s, dimension);
    const U key(task_.seed);
    const U index = s.path + task_.first;
    const F u_lobe = draw_independent<F>(key, index, U(dimension + 1u));
    const BsdfSample<F> next = bsdf.at.sample(bsdf.bsdf, wo_local, u_lobe, u_direction, TransportMode::importance);
    const F before = max_component(s.flux);
    s.flux *= next.weight;
    if constexpr (CanBeRough<Kind<F>, F>)
      if (task_.kind == PhotonKind::caustic) split(s, bsdf.bsdf, wo_local, next);
    s.weight *= max_component(s.flux) / before;
    // Roulette applies from the first surface on: photons of even flux make the best maps.
    const F q = survival_probability<F>(s.weight, s.edges, 0);
    alive = alive && next.valid && q > 0 && draw_independent<F>(key, index, U(dimension + 2u)) < q;
    s.flux *= 1 / q;
    s.weight *= 1 / q;
    s.direction = normalize(frame.to_world(next.wi_local));
    s.origin = offset_from(at.p, at.normal, s.direction, scene_.coordinate_floor);
    Base::go_on(s, alive);
  }

 private:
  using Base::scene_;

  /// Emits towards the aim targets where the task requests it; lights at infinity are not aimed.
  template <class Light>
  Emission<F> emit(const PhotonState<F>& s, const Light& light, const U& index, const Vec2<F>& u_position,
                   const Vec2<F>& u_direction, const Mask<F>& lanes) const {
    Emission<F> start = light.emit(u_position, u_direction);
    if (!task_.aimed) return start;
    const Mask<F> finite = lanes && !is_infinite<F>(light);
    if (!any(finite)) return start;
    const F u_target = draw_independent<F>(U(task_.seed), U(s.path + task_.first), U(2u));
    const Aimed<F> aimed = aim(scene_, start.at.p, u_target, u_direction);
    const Vec3<F>& direction = aimed.line.direction;
    const Vec3<F> flux = light.flux_towards(start.at, direction) * (1 / aimed.pdf) * (1 / start.crowding);
    start.direction = select(finite, direction, start.direction);
    start.flux = select(finite, flux, start.flux);
    const PointAhead<F> ahead = point_ahead(*scene_.clear_ways, index, aimed.line, start.at.p);
    start.ahead = select(finite, ahead.p, start.ahead);
    start.is_ahead = select(finite, select(ahead.valid, F(1.0f), F(0.0f)), start.is_ahead);
    return start;
  }

  Vec2<F> draw(const PhotonState<F>& s, const U& dimension) const {
    return draw2<F>(task_.sampler, U(task_.seed), U(s.path + task_.first), dimension);
  }

  using Landed = PhotonColumns<LanesOf<F>::template Column>;

  template <class Record>
  void store_on_rough(const AtSurface<PhotonState, F>& at, const Record& bsdf, const Mask<F>& lanes) {
    const PhotonState<F>& s = at.path_state;
    // Detailed scenes store on all BSDFs that can be rough: how often a hit chooses one is known, its roughness is not.
    const Mask<F> rough = scene_.detailed ? as_mask<F>(true) : bsdf.is_rough(scene_.rough_limit);
    const Mask<F> by_mirrors = equal<F>(U(s.bounced & (specularly | roughly)), U(specularly));
    store(at, lanes && rough && by_mirrors && max_component(s.flux) > 0, [&](const Vec3<F>& flux) {
      const Vec3<F> to_light = -s.direction;
      const RoughPhotonWords<F> words = rough_photon_words<F>(flux, to_light);
      return Landed{at.p.x,
                    at.p.y,
                    at.p.z,
                    words.largest,
                    from_word<F>(words.shares),
                    from_word<F>(words.direction),
                    surface_number(at.surface) | PhotonSurface::rough,
                    side_word<F>(at.normal, to_light)};
    });
  }

  /// Decides which photons a rough part has scattered.
  template <class Record>
  void split(PhotonState<F>& s, const Record& bsdf, const Vec3<F>& wo_local, const BsdfSample<F>& next) const {
    const F u = draw_independent<F>(U(task_.seed), U(s.path + task_.first), U(s.edges + part_dimensions));
    const Mask<F> smooth = next.valid && !next.delta;
    Vec3<F> weight(F(1.0f));
    const Mask<F> rough = is_by_rough_part<F>(bsdf.rough_share(scene_.rough_limit, wo_local, next.wi_local), u, weight);
    s.flux = select(smooth, Vec3<F>(s.flux * weight), s.flux);
    s.bounced = select(smooth && rough, U(s.bounced | roughly), s.bounced);
  }

  /// `make_landed` makes a photon from its flux; this function adds the edges to its surface side.
  template <class MakeLanded>
  void store(const AtSurface<PhotonState, F>& at, const Mask<F>& lanes, MakeLanded&& make_landed) {
    F stored_share(1.0f);
    Mask<F> stored = lanes;
    const F edges = to_float(at.path_state.edges);
    if (any(lanes && edges > every_edge_until)) {
      stored_share = lane_min(F(every_edge_until / edges), F(1.0f));
      stored = lanes && draw_independent<F>(U(task_.seed), U(at.path_state.path + task_.first),
                                            U(at.path_state.edges + thinning_dimensions)) < stored_share;
    }
    const std::uint32_t bits = to_bits(stored);
    if (bits == 0) return;
    PhotonDeposits& d = *task_.deposits;
    if (d.count + 2 * PhotonDeposits::slack > PhotonDeposits::capacity) task_.drain(task_);
    const auto put = [&](auto& to, const auto& value) {
      compress_store(value, bits, reinterpret_cast<std::uint32_t*>(to + d.count));
    };
    Landed landed = make_landed(Vec3<F>(at.path_state.flux * (1 / stored_share)));
    landed.surface_side = with_edges<F>(landed.surface_side, at.path_state.edges);
    zip_photons(put, d.photons, landed);
    put(d.path, at.path_state.path);
    d.count += static_cast<std::size_t>(std::popcount(bits));
  }

  PhotonTask& task_;
};

}  // namespace photonproof::inline renderer_kernels
