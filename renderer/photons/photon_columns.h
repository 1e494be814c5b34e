// What is known of a photon, from the kernel that leaves it to the map that finds it. A new column is a member and its
// place in zip_photons, and in Photon where the host reads it; only who makes it and who reads it need to know.
#pragma once

#include <cstdint>

#include "renderer/core/columns.h"
#include "renderer/photons/photon_sheet.h"
#include "scenes/meshes/vec.h"

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
constexpr void zip_photons(const F& f, Records&... records) {
  f(records.x...), f(records.y...), f(records.z...);
  f(records.red...), f(records.green...), f(records.blue...);
  f(records.surface...), f(records.sheet...);
}
static_assert(columns_visited<PhotonColumns<OneValue>>([](const auto& f, auto& row) { zip_photons(f, row); }) ==
              sizeof(PhotonColumns<OneValue>) / 4);

/// A photon by itself.
struct Photon {
  Vec3f p_world;
  Rgb flux;                   ///< W
  std::uint32_t surface = 0;  ///< where it landed: index into Scene::surfaces
  std::int32_t edges = 0;     ///< path edges from the light to here; PhotonSheet::most_edges where there are more
  std::uint32_t sheet = 0;    ///< sheet_word
};

inline Photon photon_of(const PhotonColumns<OneValue>& row) {
  return {{row.x, row.y, row.z},
          {row.red, row.green, row.blue},
          row.surface,
          static_cast<std::int32_t>(row.sheet >> PhotonSheet::edges_shift),
          row.sheet & PhotonSheet::mask};
}

inline PhotonColumns<OneValue> row_of(const Photon& photon) {
  return {photon.p_world.x, photon.p_world.y,
          photon.p_world.z, photon.flux.x,
          photon.flux.y,    photon.flux.z,
          photon.surface,   with_edges<float>(photon.sheet, static_cast<std::uint32_t>(photon.edges))};
}

}  // namespace photonproof
