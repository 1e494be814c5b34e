// Photons as tracing stores them: structure of arrays, in the order of their paths.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/large_array.h"
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
struct Photons {
  /// Arrays of a photon map may be read up to this many elements past the last photon.
  static constexpr std::size_t padding = 16;

  LargeArray<float> x, y, z;           ///< position, world
  LargeArray<float> red, green, blue;  ///< flux, W
  LargeArray<std::uint32_t> surface;   ///< index into Scene::surfaces
  LargeArray<std::uint32_t> sheet;     ///< with the path's edges from the light to here (photon_sheet.h)

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  Photon operator[](std::size_t i) const {
    return {{x[i], y[i], z[i]},
            {red[i], green[i], blue[i]},
            surface[i],
            static_cast<std::int32_t>(sheet[i] >> PhotonSheet::edges_shift),
            sheet[i] & PhotonSheet::mask};
  }

  /// Applies f to each array and the same array of `other`.
  template <class Other, class F>
  void zip(Other& other, const F& f) {
    f(x, other.x);
    f(y, other.y);
    f(z, other.z);
    f(red, other.red);
    f(green, other.green);
    f(blue, other.blue);
    f(surface, other.surface);
    f(sheet, other.sheet);
  }
  void resize(std::size_t count) {
    zip(*this, [count](auto& array, const auto&) { array.resize(count); });
  }
  /// Room for `count` photons and what a photon map, which keeps these arrays, appends to them.
  void reserve(std::size_t count) {
    zip(*this, [count](auto& array, const auto&) { array.reserve(count + padding); });
  }
  void append(const Photons& other) {
    zip(other, [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); });
  }
  void push_back(const Photon& photon) {
    x.push_back(photon.p_world.x);
    y.push_back(photon.p_world.y);
    z.push_back(photon.p_world.z);
    red.push_back(photon.flux.x);
    green.push_back(photon.flux.y);
    blue.push_back(photon.flux.z);
    surface.push_back(photon.surface);
    sheet.push_back(with_edges<float>(photon.sheet, static_cast<std::uint32_t>(photon.edges)));
  }
};

}  // namespace photonproof
