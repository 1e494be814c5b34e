// The life of a batch, the same for camera paths and photons. While there is work:
//   refill         free rows get new histories
//   meet_surfaces  rays of a pack find where they end; lanes that go on wait in the queue of their surface's BSDF kind
//   shade<Kind>    packs of one kind; survivors go to the next round's batch
// Packs are always taken from the front of a batch or queue, so all but the last are full, however histories end.
#pragma once

#include <array>
#include <bit>
#include <utility>

#include "renderer/bsdf.h"
#include "renderer/kernels/lane_batch.h"
#include "renderer/scene_view.h"

namespace photonproof {

/// A history at a surface, waiting to be shaded.
template <template <class> class History, class F>
struct AtSurface {
  History<F> history;
  Vec3<F> p, normal;
  UInt<F> surface;

  static constexpr std::size_t column_count = History<F>::column_count + 7;
  template <class Self, class Visit>
  static void columns(Self& s, Visit&& visit) {
    History<F>::columns(s.history, visit);
    visit(s.p.x), visit(s.p.y), visit(s.p.z), visit(s.normal.x), visit(s.normal.y), visit(s.normal.z);
    visit(s.surface);
  }
};

/// Self offers refill(history, first, lanes), which says which of the lanes begin a history,
/// meet_surfaces(history, active) and shade<Kind>(at_surface, active). `History` is the state between surfaces.
template <class Self, template <class> class History, class F>
class BatchKernel {
  template <class G>
  using Waiting = AtSurface<History, G>;
  using Batch = LaneBatch<History, F>;
  using Queue = LaneBatch<Waiting, F>;
  static constexpr std::size_t width = lane_count<F>;
  static constexpr std::size_t capacity = 256;  // measured: 128 to 1024 are alike; below, packs are often not full

 public:
  static constexpr std::size_t scratch_words = 2 * Batch::words(capacity) + BsdfKinds::count * Queue::words(capacity);

  /// Follows `count` histories to their ends.
  void run(std::uint32_t count) {
    std::uint32_t started = 0;
    while (started < count || next_.size() > 0) {
      std::swap(current_, next_);
      next_.clear();
      while (started < count && current_.size() + width <= capacity) {
        const std::uint32_t lanes = std::min(static_cast<std::uint32_t>(width), count - started);
        History<F> state;
        const Mask<F> begins = self().refill(state, started, first_lanes<F>(lanes));
        current_.append(state, begins);
        started += lanes;
      }
      for (Queue& queue : queues_) queue.clear();
      for (std::size_t row = 0; row < current_.size(); row += width) {
        History<F> state;
        current_.load_rows(row, state);
        self().meet_surfaces(state, first_lanes<F>(current_.size() - row));
      }
      BsdfKinds::for_each([&]<template <class> class Kind>(std::uint32_t kind) {
        const Queue& queue = queues_[kind];
        for (std::size_t row = 0; row < queue.size(); row += width) {
          Waiting<F> state;
          queue.load_rows(row, state);
          self().template shade<Kind>(state, first_lanes<F>(queue.size() - row));
        }
      });
    }
  }

 protected:
  BatchKernel(const SceneView& scene, std::uint32_t* scratch)
      : scene_(scene),
        current_(scratch, capacity),
        next_(scratch + Batch::words(capacity), capacity),
        queues_(make_queues(scratch + 2 * Batch::words(capacity), std::make_index_sequence<BsdfKinds::count>())) {}

  /// Lets lanes at `surface` wait until their BSDF's kind is shaded.
  void wait(const Waiting<F>& state, const UInt<F>& surface, const Mask<F>& alive) {
    if (scene_.one_bsdf_kind) {
      queues_[static_cast<std::size_t>(std::countr_zero(scene_.bsdf_kinds))].append(state, alive);
      return;
    }
    const UInt<F> kind = surface_word(surface, &SurfaceWords::bsdf_kind);
    for (std::uint32_t k = 0; k < BsdfKinds::count; ++k)
      if ((scene_.bsdf_kinds >> k & 1u) != 0) queues_[k].append(state, alive && equal<F>(kind, UInt<F>(k)));
  }
  void go_on(const History<F>& state, const Mask<F>& alive) { next_.append(state, alive); }

  UInt<F> surface_word(const UInt<F>& surface, std::uint32_t SurfaceWords::*word) const {
    return gather(&(scene_.surfaces->*word), UInt<F>(surface * SurfaceWords::stride));
  }
  template <template <class> class Kind>
  Kind<F> bsdf_at(const UInt<F>& surface, const Mask<F>& active) const {
    const UInt<F> valid = select(active, surface, UInt<F>(0u));
    return gather_record<Kind, F>(scene_.bsdfs, surface_word(valid, &SurfaceWords::bsdf), BsdfKinds::stride);
  }

  const SceneView& scene_;

 private:
  Self& self() { return static_cast<Self&>(*this); }
  template <std::size_t... kind>
  static std::array<Queue, sizeof...(kind)> make_queues(std::uint32_t* memory, std::index_sequence<kind...>) {
    return {Queue(memory + kind * Queue::words(capacity), capacity)...};
  }

  Batch current_, next_;
  std::array<Queue, BsdfKinds::count> queues_;  ///< by BSDF kind
};

}  // namespace photonproof
