// Photons as tracing stores them: structure of arrays, in the order of their paths.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/large_array.h"
#include "renderer/photons/photon_columns.h"
#include "renderer/photons/photon_sheet.h"
#include "scenes/meshes/vec.h"

namespace photonproof {

struct Photon {
  Vec3f p_world;
  Rgb flux;                   ///< W
  std::uint32_t surface = 0;  ///< where it landed: index into Scene::surfaces
  std::int32_t edges = 0;     ///< path edges from the light to here; PhotonSheet::most_edges where there are more
  std::uint32_t sheet = 0;    ///< sheet_word
};

/// Every array has the same size: 32 bytes a photon. Positions are finite.
struct Photons : PhotonColumns<LargeArray> {
  /// Arrays of a photon map may be read up to this many elements past the last photon.
  static constexpr std::size_t padding = 16;

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  Photon operator[](std::size_t i) const {
    return {{x[i], y[i], z[i]},
            {red[i], green[i], blue[i]},
            surface[i],
            static_cast<std::int32_t>(sheet[i] >> PhotonSheet::edges_shift),
            sheet[i] & PhotonSheet::mask};
  }

  void resize(std::size_t count) {
    zip_photons([count](auto& array) { array.resize(count); }, *this);
  }
  /// Room for `count` photons and what a photon map, which keeps these arrays, appends to them.
  void reserve(std::size_t count) {
    zip_photons([count](auto& array) { array.reserve(count + padding); }, *this);
  }
  void append(const Photons& other) {
    zip_photons([](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); }, *this, other);
  }
  void push_back(const Photon& photon) {
    const PhotonColumns<OneValue> row{
        photon.p_world.x, photon.p_world.y,
        photon.p_world.z, photon.flux.x,
        photon.flux.y,    photon.flux.z,
        photon.surface,   with_edges<float>(photon.sheet, static_cast<std::uint32_t>(photon.edges))};
    zip_photons([](auto& array, const auto& value) { array.push_back(value); }, *this, row);
  }
};

}  // namespace photonproof
