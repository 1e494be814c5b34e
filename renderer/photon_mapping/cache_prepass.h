// The irradiance cache of the photon mapper: records of the light that diffuse surfaces throw on each other, made
// before the first pass and the same in all of them. A cache that grows while it is read depends on who comes first;
// this one follows from the seed alone.
//   Points are where one camera path of every pixel first meets a Lambertian surface, taken from a lattice that gets
//   finer, in a scrambled order. Rounds take the next few that no record stands for, gather their light in parallel,
//   and insert them in order where they are still needed.
//   A record's rays are bounces as final_gather.h has them, through maps of photons of their own. Its light is that of
//     L S* D(y) S* D(x)  and  L S+ D(y) S* D(x)  and  L (S|D)* D S* D(y) S* D(x)
//   so that direct light and the caustic map are left to every pass. Since records stay, their error and that of
//   interpolation do not fall with more samples. A limit of the paths' length takes x as seen directly.
#pragma once

#include "renderer/core/parallel.h"
#include "renderer/photon_mapping/cache_error.h"
#include "renderer/photon_mapping/gather_area.h"
#include "renderer/photon_mapping/irradiance_cache.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/planning/plan.h"

namespace photonproof::inline renderer_photon_mapping {

struct CheckedCache {
  IrradianceCache cache;
  CacheError error;
};

CheckedCache make_irradiance_cache(const RenderPlan& plan, const PhotonSource& source, const GatherAreas& areas,
                                   const Tile& window, RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
