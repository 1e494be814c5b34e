// The data of a photon, from the kernel that stores it to the map that finds it. A new column is a member and its place
// in zip_photons, and in Photon where the host reads it. Only the code that fills or reads it must change.
#pragma once

#include <cstdint>

#include "renderer/core/columns.h"
#include "renderer/photons/rough_photon.h"
#include "renderer/photons/surface_side.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_photons {

/// The number of a surface, below bits in which photons and gathers must agree. Three are of the normals that maps show
/// (MappedNormals), one of a rough part (rough_photon.h).
struct PhotonSurface {
  static constexpr int number_bits = 28;
  static constexpr std::uint32_t number = (1u << number_bits) - 1, rough = 1u << 31;
};

template <template <class> class Column>
struct PhotonColumns {
  Column<float> x, y, z;               ///< position, world
  Column<float> red, green, blue;      ///< flux, W
  Column<std::uint32_t> surface;       ///< PhotonSurface: index into Scene::surfaces
  Column<std::uint32_t> surface_side;  ///< with the path's edges from the light to here (surface_side.h)
};

/// Calls f with one column after the other of all records.
template <class F, class... Records>
constexpr void zip_photons(const F& f, Records&... records) {
  f(records.x...), f(records.y...), f(records.z...);
  f(records.red...), f(records.green...), f(records.blue...);
  f(records.surface...), f(records.surface_side...);
}
static_assert(columns_visited<PhotonColumns<OneValue>>([](const auto& f, auto& row) { zip_photons(f, row); }) ==
              sizeof(PhotonColumns<OneValue>) / 4);

/// A photon by itself.
struct Photon {
  Vec3f p_world;
  Rgb flux;                        ///< W
  std::uint32_t surface = 0;       ///< where it landed: PhotonSurface
  std::int32_t edges = 0;          ///< path edges from the light to here; at most SurfaceSide::most_edges
  std::uint32_t surface_side = 0;  ///< side_word
};

inline Photon photon_of(const PhotonColumns<OneValue>& row) {
  const bool is_rough = (row.surface & PhotonSurface::rough) != 0;
  return {{row.x, row.y, row.z},
          is_rough ? flux_of_rough_photon<float>({row.red, to_word(row.green), to_word(row.blue)})
                   : Rgb{row.red, row.green, row.blue},
          row.surface,
          static_cast<std::int32_t>(row.surface_side >> SurfaceSide::edges_shift),
          row.surface_side & SurfaceSide::mask};
}

inline PhotonColumns<OneValue> row_of(const Photon& photon) {
  return {photon.p_world.x, photon.p_world.y,
          photon.p_world.z, photon.flux.x,
          photon.flux.y,    photon.flux.z,
          photon.surface,   with_edges<float>(photon.surface_side, static_cast<std::uint32_t>(photon.edges))};
}

}  // namespace photonproof::inline renderer_photons
