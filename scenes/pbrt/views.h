// pbrt's directives before WorldBegin: camera, film, filter, sampler and integrator.
#pragma once

#include <optional>

#include "scenes/pbrt/state.h"

namespace photonproof::inline scenes_pbrt {

/// The directives as given; pbrt's defaults stand in for those that are not.
struct PbrtViews {
  std::optional<PbrtEntity> camera, film, filter, sampler, integrator;
  std::string camera_medium;
};

/// Sets the scene's sensor and integrator, and the context's `to_ours` and `exposure`.
void add_pbrt_views(PbrtContext& context, const PbrtViews& views);

/// The integrator suits the scene: one for media where there are some.
void choose_pbrt_integrator(PbrtContext& context, const PbrtViews& views);

}  // namespace photonproof::inline scenes_pbrt
