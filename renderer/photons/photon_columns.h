// What is known of a photon, from the kernel that leaves it to the map that finds it. A new column is a member and its
// place in zip_photons; only who makes it and who reads it need to know.
#pragma once

#include <cstdint>

#include "renderer/core/columns.h"

namespace photonproof {

template <template <class> class Column>
struct PhotonColumns {
  Column<float> x, y, z;           ///< position, world
  Column<float> red, green, blue;  ///< flux, W
  Column<std::uint32_t> surface;   ///< index into Scene::surfaces
  Column<std::uint32_t> sheet;     ///< with the path's edges from the light to here (photon_sheet.h)
};

/// Calls f with one column after the other of all records.
template <class F, class... Records>
void zip_photons(const F& f, Records&... records) {
  f(records.x...), f(records.y...), f(records.z...);
  f(records.red...), f(records.green...), f(records.blue...);
  f(records.surface...), f(records.sheet...);
}

}  // namespace photonproof
