// The life of a batch, the same for camera paths and photons. A round has three steps, repeated while there is work.
//   `refill`         Free rows get new paths.
//   `meet_surfaces`  Finds where rays of a pack end. Lanes that go on wait in the queue of their surface's BSDF kind.
//   `shade<Kind>`    Shades packs of one kind. Survivors go to the next round's batch.
// Packs are always taken from the front of a batch or queue, so only the last has empty lanes, however paths end.
#pragma once

#include <array>
#include <bit>
#include <utility>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/bsdfs/scattering.h"
#include "renderer/kernels/lane_batch.h"
#include "renderer/scene/scene_view.h"
#include "renderer/scene/surface_detail.h"

namespace photonproof::inline renderer_kernels {

/// A path at a surface, waiting to be shaded.
template <template <class> class AnyPathState, class F>
struct AtSurface {
  AnyPathState<F> path_state;
  Vec3<F> p, normal;  ///< geometric
  UInt<F> surface;    ///< while it waits in a detailed scene: the number of its SurfaceDetail

  static constexpr std::size_t column_count = AnyPathState<F>::column_count + 7;
  template <class Self, class Visit>
  static void columns(Self& s, Visit&& visit) {
    AnyPathState<F>::columns(s.path_state, visit);
    visit(s.p.x), visit(s.p.y), visit(s.p.z), visit(s.normal.x), visit(s.normal.y), visit(s.normal.z);
    visit(s.surface);
  }
};

/// Paths in progress, and services common to all kernels. `Path` is the state between surfaces, `mode` what paths
/// transport.
template <template <class> class AnyPathState, TransportMode mode, class F>
class BatchQueues {
 protected:
  using Value = F;
  template <class G>
  using StateOf = AnyPathState<G>;
  template <class G>
  using Waiting = AtSurface<AnyPathState, G>;
  using Batch = LaneBatch<AnyPathState, F>;
  using Queue = LaneBatch<Waiting, F>;
  static constexpr std::size_t width = lane_count<F>;
  static constexpr std::size_t capacity = 256;  // measured: 128 to 1024 are alike; below, packs are often not full

 public:
  static constexpr std::size_t scratch_words = 2 * Batch::words(capacity) + BsdfKinds::count * Queue::words(capacity);

 protected:
  BatchQueues(const SceneView& scene, std::uint32_t* scratch)
      : scene_(scene),
        current_(scratch, capacity),
        next_(scratch + Batch::words(capacity), capacity),
        queues_(make_queues(scratch + 2 * Batch::words(capacity), std::make_index_sequence<BsdfKinds::count>())) {}

  /// Queues lanes until their BSDF's kind is shaded. `draw_choice()` is uniform in [0,1), for detail_at.
  template <class Draw>
  void wait(Waiting<F>&& state, const Mask<F>& alive, Draw&& draw_choice) {
    if (scene_.detailed) {
      const UInt<F> kind = add_details(state, alive, draw_choice());
      append_by_kind(state, kind, alive);
    } else if (scene_.one_bsdf_kind) {
      queues_[static_cast<std::size_t>(std::countr_zero(scene_.bsdf_kinds))].append(state, alive);
    } else {
      append_by_kind(state, surface_word(state.surface, &SurfaceWords::bsdf_kind), alive);
    }
  }
  void go_on(const AnyPathState<F>& state, const Mask<F>& alive) { next_.append(state, alive); }

  UInt<F> surface_word(const UInt<F>& surface, std::uint32_t SurfaceWords::*word) const {
    return gather(&(scene_.surfaces->*word), UInt<F>(surface * SurfaceWords::stride));
  }
  /// The BSDF of waiting lanes. From here on `at.surface` is their surface, with the bits in which photons and gathers
  /// must agree (MappedNormals).
  template <template <class> class Kind>
  ScatteringBsdf<Kind<F>, F> scattering_at(Waiting<F>& at, const Mask<F>& active) const {
    const UInt<F> valid = select(active, at.surface, UInt<F>(0u));
    if (!scene_.detailed) {
      const UInt<F> bsdf = surface_word(valid, &SurfaceWords::bsdf);
      return {gather_record<Kind, F>(scene_.bsdfs, bsdf, BsdfKinds::stride), {Frame<F>(at.normal)}};
    }
    const SurfaceDetail& base = details_.front();
    const UInt<F> first = valid * SurfaceDetail::stride;
    const auto gather3 = [&](const Vec3f& member) {
      return Vec3<F>{gather(&member.x, first), gather(&member.y, first), gather(&member.z, first)};
    };
    at.surface = gather(&base.surface, first);
    Scattering<F> scattering{Frame<F>(gather3(base.normal))};
    Frame<F>& frame = scattering.frame;
    const Vec3<F> tangent = gather3(base.tangent);
    const Mask<F> has_tangent = dot(tangent, tangent) > 0;
    if (any(has_tangent)) {
      const Frame<F> along(frame.n, tangent);
      frame.s = select(has_tangent, along.s, frame.s);
      frame.t = select(has_tangent, along.t, frame.t);
    }
    scattering.bent = scene_.bends_normals;
    scattering.mapped = scene_.maps_normals;
    if (scattering.bent) scattering.ng = frame.to_local(at.normal);
    if (scattering.mapped) {
      MappedNormals<F>& maps = scattering.maps;
      for (int map = 0; map < 2; ++map) {
        maps.below[map] = frame.to_local(gather3(base.below[map]));
        maps.shadow[map] = gather(&base.shadow[map], first);
      }
      maps.state = gather(&base.state, first);
      maps.chance = gather(&base.chance, first);
    }
    return {gather_record<Kind, F>(base.record, valid, SurfaceDetail::stride), scattering};
  }

  /// Empties the queues before a round.
  void begin_round() {
    std::swap(current_, next_);
    next_.clear();
    for (Queue& queue : queues_) queue.clear();
    detail_count_ = 0;
  }

  const SceneView& scene_;
  Batch current_, next_;
  std::array<Queue, BsdfKinds::count> queues_;  ///< by BSDF kind

 private:
  template <std::size_t... kind>
  static std::array<Queue, sizeof...(kind)> make_queues(std::uint32_t* memory, std::index_sequence<kind...>) {
    return {Queue(memory + kind * Queue::words(capacity), capacity)...};
  }

  void append_by_kind(const Waiting<F>& state, const UInt<F>& kind, const Mask<F>& alive) {
    for (std::uint32_t k = 0; k < BsdfKinds::count; ++k)
      if ((scene_.bsdf_kinds >> k & 1u) != 0) queues_[k].append(state, alive && equal<F>(kind, UInt<F>(k)));
  }

  /// Evaluates the lanes' details, numbers them in `state.surface` and returns the kinds of their BSDFs.
  UInt<F> add_details(Waiting<F>& state, const Mask<F>& alive, const F& u_choice) {
    const auto spread = [](const auto& value, auto* to) { store_from(value, to); };
    float p[3][width], normal[3][width], direction[3][width], u[width];
    std::uint32_t surface[width], primitive[width], kind[width] = {};
    const auto spread3 = [&](const Vec3<F>& v, float(&to)[3][width]) {
      spread(v.x, to[0]), spread(v.y, to[1]), spread(v.z, to[2]);
    };
    spread3(state.p, p);
    spread3(state.normal, normal);
    spread3(state.path_state.direction, direction);
    spread(u_choice, u);
    spread(state.surface, surface);
    spread(state.path_state.from, primitive);
    const auto lane_of = [](const float(&v)[3][width], std::size_t i) { return Vec3f(v[0][i], v[1][i], v[2][i]); };
    for (std::uint32_t bits = to_bits(alive); bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      SurfaceDetail& detail = details_[detail_count_];
      detail_at(scene_, surface[i], primitive[i], lane_of(p, i), lane_of(normal, i), lane_of(direction, i), u[i], mode,
                detail);
      kind[i] = detail.kind;
      surface[i] = static_cast<std::uint32_t>(detail_count_++);
    }
    load_into(state.surface, surface);
    UInt<F> kinds;
    load_into(kinds, kind);
    return kinds;
  }

  std::array<SurfaceDetail, capacity> details_;  ///< details of the round's waiting lanes, in detailed scenes
  std::size_t detail_count_ = 0;
};

/// Follows paths to their ends. `Steps` is a BatchQueues or derives from one. Self has refill(path, first, lanes),
/// which returns the lanes that begin a path, meet_surfaces(path, active) and shade<Kind>(at_surface, active).
template <class Self, class Steps>
class BatchKernel : public Steps {
  using F = typename Steps::Value;
  using State = typename Steps::template StateOf<F>;
  using Waiting = typename Steps::template Waiting<F>;
  using Steps::width;

 public:
  /// Follows `count` paths to their ends.
  void run(std::uint32_t count) {
    std::uint32_t started = 0;
    while (started < count || next_.size() > 0) {
      Steps::begin_round();
      while (started < count && current_.size() + width <= capacity) {
        const std::uint32_t lanes = std::min(static_cast<std::uint32_t>(width), count - started);
        State state;
        const Mask<F> begins = self().refill(state, started, first_lanes<F>(lanes));
        current_.append(state, begins);
        started += lanes;
      }
      for (std::size_t row = 0; row < current_.size(); row += width) {
        State state;
        current_.load_rows(row, state);
        self().meet_surfaces(state, first_lanes<F>(current_.size() - row));
      }
      BsdfKinds::for_each([&]<template <class> class Kind>(std::uint32_t kind) {
        const auto& queue = queues_[kind];
        for (std::size_t row = 0; row < queue.size(); row += width) {
          Waiting state;
          queue.load_rows(row, state);
          self().template shade<Kind>(state, first_lanes<F>(queue.size() - row));
        }
      });
    }
  }

 protected:
  using Steps::Steps;

 private:
  Self& self() { return static_cast<Self&>(*this); }

  using Steps::current_, Steps::next_, Steps::queues_, Steps::capacity;
};

}  // namespace photonproof::inline renderer_kernels
