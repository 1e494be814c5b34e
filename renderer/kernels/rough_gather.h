// Gathers photons where a camera path meets the rough part of a BSDF. Each photon counts by f of its incoming
// direction, so the gather happens where the BSDF is known. It handles one point after the other, with one photon per
// lane.
//
// Classes of paths. Every scattering by a BSDF that is not Lambertian is by its rough part, G, or by the rest, S. The
// rest is a mirror or a sharp highlight (is_by_rough_part decides, for light paths and camera paths alike). There are
// three classes without a Lambertian vertex.
//   L S* E                  Rays that meet lights, and light samples where S is not a mirror.
//   L G (S|G)* E            Light samples at G and the ray that leaves it, weighted.
//   L S+ G (S|G)* E         The caustic map at G.
// So from G on, light counts only at the end of the next ray and at further G. For a Lambertian vertex (final_gather.h)
// G is like S: its photons have been through both.
#pragma once

#include <bit>

#include "renderer/bsdfs/rough_part.h"
#include "renderer/bsdfs/scattering.h"
#include "renderer/kernels/final_gather.h"
#include "renderer/kernels/tasks.h"
#include "renderer/photons/photon_gather.h"
#include "renderer/photons/rough_photon.h"
#include "renderer/scene/surface_detail.h"

namespace photonproof::rough_gather {

using final_gather::any_rough, final_gather::last_rough;

/// Whether G has scattered the path, from PathState::gathering; false from the first Lambertian vertex on.
template <class F>
Mask<F> is_behind_rough(const UInt<F>& gathering) {
  return !equal<F>(UInt<F>(gathering & any_rough), UInt<F>(0u));
}
/// Whether light that the path's ray meets counts.
template <class F>
Mask<F> counts_light(const UInt<F>& gathering) {
  return !is_behind_rough<F>(gathering) || !equal<F>(UInt<F>(gathering & last_rough), UInt<F>(0u));
}
/// PathState::gathering on the way to the first Lambertian vertex.
template <class F>
UInt<F> after(const UInt<F>& gathering, const Mask<F>& by_rough_part) {
  return select(by_rough_part, UInt<F>(gathering | any_rough | last_rough), UInt<F>(gathering & ~last_rough));
}

/// A struct of lanes, with one lane's values in all of them.
template <class F, class T>
T in_all_lanes(const T& lanes, std::size_t lane) {
  constexpr std::size_t words = sizeof(T) / sizeof(F);
  static_assert(sizeof(T) == words * sizeof(F) && std::is_trivially_copyable_v<T>);
  F columns[words];
  std::memcpy(columns, static_cast<const void*>(&lanes), sizeof lanes);
  for (F& column : columns) {
    float of_lanes[lane_count<F>];
    store_from(column, of_lanes);
    column = F(of_lanes[lane]);
  }
  T all = lanes;
  std::memcpy(static_cast<void*>(&all), columns, sizeof all);
  return all;
}

/// Photons on one surface side of a surface that count for one point. As in gather_by, they come in blocks whose sums
/// are added in one tree.
template <class F, class Record>
class Point {
  static constexpr std::size_t block = gathering::block, parts = block / lane_count<F>;

 public:
  Point(const ScatteringBsdf<Record, F>& bsdf, const RoughLimit& limit, const Vec3<F>& wo_local, std::size_t lane)
      : limit_(limit),
        bsdf_(in_all_lanes<F>(bsdf.bsdf, lane)),
        at_{in_all_lanes<F>(bsdf.at.frame, lane), bsdf.at.bent, bsdf.at.mapped, in_all_lanes<F>(bsdf.at.ng, lane),
            in_all_lanes<F>(bsdf.at.maps, lane)},
        wo_(in_all_lanes<F>(wo_local, lane)) {}

  /// Adds the point with its gathered photons to the queue; there must be room.
  void radiance_estimate(RoughGathers& rough, const GatherPoint& point) {
    const float radius = rough.radius[point.path], narrow_radius = radius * rough.narrow_part;
    PhotonFilter filter{point.surface, rough.max_edges - static_cast<std::int32_t>(point.edges),
                        rough.tests[surface_number(point.surface)], point.surface_side};
    if (filter.test == SheetTest::side_and_normal)
      find<SheetTest::side_and_normal>(rough.map, point.p, radius, narrow_radius, filter);
    else
      find<SheetTest::side>(rough.map, point.p, radius, narrow_radius, filter);
    append(rough.points, point, radius, sum(wide_));
    append(rough.narrow, point, narrow_radius, sum(narrow_));
  }

 private:
  template <SheetTest test>
  void find(const PhotonView& map, const Vec3f& p, float radius, float narrow_radius, const PhotonFilter& filter) {
    const gathering::Look<test> look(p, radius, filter);
    const float narrow2 = narrow_radius * narrow_radius;
    map.for_each_run(p, radius, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; i += block) {
        std::uint32_t counted[block];
        for (std::size_t part = 0; part < gathering::parts; ++part)
          store_from(look.counts(map, i + part * gathering::width), counted + part * gathering::width);
        for (std::size_t part = 0; part < parts; ++part) {
          UInt<F> counts;
          load_into(counts, counted + part * lane_count<F>);
          const std::size_t at = i + part * lane_count<F>;
          const Mask<F> lanes = !equal<F>(counts, UInt<F>(0u)) && first_lanes<F>(end > at ? end - at : 0);
          if (any(lanes)) add(map, at, part, p, narrow2, lanes);
        }
      }
    });
  }

  void append(GatherPoints& points, const GatherPoint& point, float radius, const Vec3f& flux) const {
    const GatherColumns<OneValue> row{point.p.x,      point.p.y,
                                      point.p.z,      point.weight.x,
                                      point.weight.y, point.weight.z,
                                      point.path,     point.surface,
                                      point.edges,    point.surface_side,
                                      radius,         flux.x,
                                      flux.y,         flux.z,
                                      count_,         0};
    zip_gather_points([&](auto* column, const auto& value) { column[points.count] = value; }, points, row);
    ++points.count;
  }

  void add(const PhotonView& map, std::size_t at, std::size_t part, const Vec3f& p, float narrow2,
           const Mask<F>& lanes) {
    F x, y, z;
    load_into(x, map.x + at), load_into(y, map.y + at), load_into(z, map.z + at);
    RoughPhotonWords<F> words;
    load_into(words.largest, map.red + at);
    load_into(words.shares, map.green + at);
    load_into(words.direction, map.blue + at);
    const Vec3<F> to_light = at_.frame.to_local(direction_of_rough_photon<F>(words));
    const RoughPart<Record, F> rough{bsdf_, limit_, as_mask<F>(false)};
    Vec3<F> brought = at_.eval(rough, wo_, to_light) * flux_of_rough_photon<F>(words);
    if (at_.bent) {
      const F to_ng = lane_abs(dot(at_.ng, to_light));
      brought *= select(to_ng > 0, F(lane_abs(to_light.z) / to_ng), F(0.0f));
    }
    const Vec3<F> apart{x - p.x, y - p.y, z - p.z};
    const Mask<F> near = lanes && dot(apart, apart) <= narrow2;
    wide_[part] += select(lanes, brought, Vec3<F>(F(0.0f)));
    narrow_[part] += select(near, brought, Vec3<F>(F(0.0f)));
    count_ += static_cast<std::uint32_t>(count_lanes(lanes));
  }

  static Vec3f sum(const Vec3<F>* partial) {
    float s[3][block];
    for (std::size_t part = 0; part < parts; ++part) {
      store_from(partial[part].x, s[0] + part * lane_count<F>);
      store_from(partial[part].y, s[1] + part * lane_count<F>);
      store_from(partial[part].z, s[2] + part * lane_count<F>);
    }
    return {gathering::sum(s[0], 0.0f), gathering::sum(s[1], 0.0f), gathering::sum(s[2], 0.0f)};
  }

  const RoughLimit limit_;
  const Record bsdf_;
  const Scattering<F> at_;
  const Vec3<F> wo_;
  Vec3<F> wide_[parts] = {}, narrow_[parts] = {};
  std::uint32_t count_ = 0;
};

}  // namespace photonproof::rough_gather
