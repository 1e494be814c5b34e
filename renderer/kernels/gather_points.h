// Points of camera paths that wait for the light of photons: a queue in columns. The path kernel adds points, the
// gather kernel gathers their photons and adds their light to the paths' radiance.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/columns.h"
#include "renderer/core/large_array.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_kernels {

/// A new column is a member and its place in zip_gather_points; only the code that fills or reads it must change.
template <template <class> class Column>
struct GatherColumns {
  // Members of the path.
  Column<float> x, y, z;                                     ///< Position, world.
  Column<float> weight_red, weight_green, weight_blue;       ///< Throughput x f: radiance is weight x irradiance.
  Column<std::uint32_t> path, surface, edges, surface_side;  ///< The camera path's edges; surface_side: side_word.
  // Members of the gather in a map.
  Column<float> radius;
  Column<float> flux_red, flux_green, flux_blue;  ///< Gathered, W.
  Column<std::uint32_t> found;                    ///< Number of photons.
  Column<float> area;                             ///< Divisor of the flux; 0 where nothing was found.
};

/// Calls f with one column after the other of all records.
template <class F, class... Records>
constexpr void zip_gather_points(const F& f, Records&... records) {
  f(records.x...), f(records.y...), f(records.z...);
  f(records.weight_red...), f(records.weight_green...), f(records.weight_blue...);
  f(records.path...), f(records.surface...), f(records.edges...), f(records.surface_side...);
  f(records.radius...);
  f(records.flux_red...), f(records.flux_green...), f(records.flux_blue...);
  f(records.found...), f(records.area...);
}
static_assert(columns_visited<GatherColumns<OneValue>>([](const auto& f, auto& row) { zip_gather_points(f, row); }) ==
              sizeof(GatherColumns<OneValue>) / 4);

/// The columns as kernels see them.
struct GatherPoints : GatherColumns<Pointer> {
  std::size_t count = 0;
};

/// A waiting point, for the host.
struct GatherPoint {
  Vec3f p;
  Rgb weight;
  std::uint32_t path = 0, surface = 0, edges = 0, surface_side = 0;
};

class GatherQueue {
 public:
  explicit GatherQueue(std::size_t capacity) { reserve(capacity); }

  /// Makes room for this many points in all; earlier views become invalid.
  void reserve(std::size_t capacity) {
    zip_gather_points([&](auto& column) { column.resize(capacity + slack); }, columns_);
  }
  std::size_t size() const { return count_; }
  /// Sets the number of points after a kernel has added some.
  void set_size(std::size_t count) { count_ = count; }
  GatherPoints view() {
    GatherPoints view{};
    zip_gather_points([](auto& pointer, auto& column) { pointer = column.data(); }, view, columns_);
    view.count = count_;
    return view;
  }
  GatherPoint operator[](std::size_t i) const {
    const auto& c = columns_;
    return {{c.x[i], c.y[i], c.z[i]},
            {c.weight_red[i], c.weight_green[i], c.weight_blue[i]},
            c.path[i],
            c.surface[i],
            c.edges[i],
            c.surface_side[i]};
  }
  void push_back(const GatherPoint& point) {
    const GatherColumns<OneValue> row{point.p.x,
                                      point.p.y,
                                      point.p.z,
                                      point.weight.x,
                                      point.weight.y,
                                      point.weight.z,
                                      point.path,
                                      point.surface,
                                      point.edges,
                                      point.surface_side,
                                      0,
                                      0,
                                      0,
                                      0,
                                      0,
                                      0};
    zip_gather_points([&](auto& column, const auto& value) { column[count_] = value; }, columns_, row);
    ++count_;
  }

 private:
  static constexpr std::size_t slack = 16;  ///< points that a pack may touch beyond the last one
  GatherColumns<LargeArray> columns_;
  std::size_t count_ = 0;
};

}  // namespace photonproof::inline renderer_kernels
