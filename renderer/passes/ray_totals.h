// Rays of a whole render. Sums of integers do not depend on their order.
#pragma once

#include <atomic>
#include <cstdint>

#include "renderer/core/ray_counts.h"
#include "renderer/passes/render_job.h"

namespace photonproof::inline renderer_passes {

class RayTotals {
 public:
  void add(const RayCounts& c) {
    camera_ += c.camera;
    bounce_ += c.bounce;
    shadow_ += c.shadow;
    photon_ += c.photon;
  }
  /// Not to be called while others add.
  RayCounts counts() const { return {camera_, bounce_, shadow_, photon_}; }
  void set(const RayCounts& c) {
    camera_ = c.camera;
    bounce_ = c.bounce;
    shadow_ = c.shadow;
    photon_ = c.photon;
  }
  /// Adds them to the counts of the stats.
  void store(RenderStats& stats) const {
    stats.counts["rays_camera"] += static_cast<double>(camera_);
    stats.counts["rays_bounce"] += static_cast<double>(bounce_);
    stats.counts["rays_shadow"] += static_cast<double>(shadow_);
    stats.counts["rays_photon"] += static_cast<double>(photon_);
  }

 private:
  std::atomic<std::uint64_t> camera_{0}, bounce_{0}, shadow_{0}, photon_{0};
};

}  // namespace photonproof::inline renderer_passes
