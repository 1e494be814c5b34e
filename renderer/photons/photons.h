// Photons as tracing stores them: structure of arrays, in the order of their paths.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/large_array.h"
#include "renderer/photons/photon_columns.h"
#include "renderer/photons/surface_side.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_photons {

/// Every array has the same size: 32 bytes per photon in all. Positions are finite.
struct Photons : PhotonColumns<LargeArray> {
  /// Arrays of a photon map may be read up to this many elements past the last photon.
  static constexpr std::size_t padding = 16;

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  Photon operator[](std::size_t i) const {
    PhotonColumns<OneValue> row;
    zip_photons([i](auto& value, const auto& array) { value = array[i]; }, row, *this);
    return photon_of(row);
  }

  void resize(std::size_t count) {
    zip_photons([count](auto& array) { array.resize(count); }, *this);
  }
  /// Reserves memory for `count` photons and the padding of a photon map, which keeps these arrays.
  void reserve(std::size_t count) {
    zip_photons([count](auto& array) { array.reserve(count + padding); }, *this);
  }
  void append(const Photons& other) {
    zip_photons([](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); }, *this, other);
  }
  void push_back(const Photon& photon) {
    const PhotonColumns<OneValue> row = row_of(photon);
    zip_photons([](auto& array, const auto& value) { array.push_back(value); }, *this, row);
  }
};

}  // namespace photonproof::inline renderer_photons
