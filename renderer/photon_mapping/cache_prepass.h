// The photon mapper's irradiance cache: records of the light that diffuse surfaces throw on each other. It is made
// before the first pass and is the same in all passes. A cache that grows while it is read would depend on the order of
// threads; this one follows from the seed alone.
//   Candidate points are where one camera path of every pixel first meets a Lambertian surface. They are taken
//   from lattices that get finer, in a scrambled order. Each round takes the next few points that no record covers,
//   gathers their light in parallel, and inserts them in order where they are still needed.
//   A record's rays are bounces as in final_gather.h, through maps with photons of their own. A record's light is
//     `L S* D(y) S* D(x)`  and  `L S+ D(y) S* D(x)`  and  `L (S|D)* D S* D(y) S* D(x)`,
//   so that every pass adds direct light and the caustic map itself. Records stay: their error and that of
//   interpolation do not fall with more samples. A limit of the paths' length counts x as directly visible.
#pragma once

#include "renderer/core/parallel.h"
#include "renderer/irradiance/cache_error.h"
#include "renderer/irradiance/irradiance_cache.h"
#include "renderer/photon_mapping/gather_area.h"
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
