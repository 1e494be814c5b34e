#include "renderer/passes/aov.h"

#include "scenes/base/input_error.h"

namespace photonproof::inline renderer_passes {

const std::vector<AovRow>& aov_table() {
  static const std::vector<AovRow> table{
      {Aov::whole, "whole", "all light", true, true, true},
      {Aov::direct, "direct", "light of camera paths without photons: lights, mirrors, glass, direct light", true,
       false, false},
      {Aov::caustics, "caustics", "light of the caustic photon map", false, true, false},
      {Aov::global, "global", "light of the global photon map", false, false, true},
      {Aov::indirect, "indirect", "light of both photon maps", false, true, true},
      {Aov::photons, "photons",
       "the stored photons that the camera sees as dots, a mean one's being 1, for each sample of the pass", false,
       true, true},
      {Aov::radius, "radius", "radius of gathers in pixels: caustic map red, global map green", true, true, true},
      {Aov::samples, "samples", "camera samples of the pixel for each sample of the pass", true, true, true},
      {Aov::cache_records, "cache-records",
       "the points of an irradiance cache, made for any `indirect`, as dots on the dimmed image. The radius of red "
       "dots is 1.5 pixels, of yellow 4, of green 9 and of blue 24",
       true, true, true},
      {Aov::time, "time",
       "microseconds of the pixel's tile, for each of its pixels and samples of the pass; not the same twice", true,
       true, true},
  };
  return table;
}

Aov aov_named(const std::string& name) {
  std::string names;
  for (const AovRow& row : aov_table()) {
    if (name == row.name) return row.view;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw InputError("--view", "there is no view '" + name + "', expected one of " + names);
}

}  // namespace photonproof::inline renderer_passes
