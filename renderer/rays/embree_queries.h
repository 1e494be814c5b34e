// Embree's queries for the rays of a block: one by one, or together as a packet. Both find the same bits on flat faces:
// there Embree's robust intersectors do the same arithmetic for one ray and for many (packets_test.cpp). On curves they
// do not.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "renderer/rays/embree.h"
#include "renderer/rays/for_each_lane.h"
#include "renderer/rays/trace.h"

namespace photonproof::inline renderer_rays {

/// The lanes with a ray that can be traced: Debian's Embree does not ignore invalid rays, so they are filtered here.
inline std::uint32_t traceable(const RayBlock& rays) {
  std::uint32_t lanes = 0;
  for_each_lane(rays.active, [&](std::size_t i) {
    const float sum = rays.origin_x[i] + rays.origin_y[i] + rays.origin_z[i] + rays.direction_x[i] +
                      rays.direction_y[i] + rays.direction_z[i];
    if (std::isfinite(sum)) lanes |= 1u << i;
  });
  return lanes;
}

inline RTCRay ray_of_lane(const RayBlock& rays, std::size_t i, float t_far) {
  return {.org_x = rays.origin_x[i],
          .org_y = rays.origin_y[i],
          .org_z = rays.origin_z[i],
          .tnear = 0,
          .dir_x = rays.direction_x[i],
          .dir_y = rays.direction_y[i],
          .dir_z = rays.direction_z[i],
          .time = 0,
          .tfar = t_far,
          .mask = 0xFFFFFFFFu,
          .id = rays.light[i],
          .flags = 0};
}

/// Where rays of a block end, as Embree says: `t` is first how far each ray reaches. On a miss `geometry` is invalid,
/// and then the rest is undefined.
struct alignas(64) BlockEnds {
  float t[RayBlock::width], u[RayBlock::width], v[RayBlock::width];
  unsigned instance[RayBlock::width], geometry[RayBlock::width], primitive[RayBlock::width];
};

/// The end of one lane's ray.
inline void intersect_one(RTCScene scene, const RayBlock& rays, std::size_t i, BlockEnds& ends) {
  RTCRayHit query{};
  query.ray = ray_of_lane(rays, i, ends.t[i]);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#ifdef PHOTONPROOF_EMBREE4
  rtcIntersect1(scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
  ends.t[i] = query.ray.tfar;
  ends.u[i] = query.hit.u;
  ends.v[i] = query.hit.v;
  ends.instance[i] = query.hit.instID[0];
  ends.geometry[i] = query.hit.geomID;
  ends.primitive[i] = query.hit.primID;
}

inline bool is_occluded(RTCScene scene, const RayBlock& rays, std::size_t i) {
  RTCRay query = ray_of_lane(rays, i, segment_end);
#ifdef PHOTONPROOF_EMBREE4
  rtcOccluded1(scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &query);
#endif
  return query.tfar < 0;
}

/// Embree's packets of n rays.
template <std::size_t n>
struct Packet;
template <>
struct Packet<4> {
  using Ray = RTCRay4;
  using RayHit = RTCRayHit4;
  static constexpr auto intersect = &rtcIntersect4;
  static constexpr auto occluded = &rtcOccluded4;
};
template <>
struct Packet<8> {
  using Ray = RTCRay8;
  using RayHit = RTCRayHit8;
  static constexpr auto intersect = &rtcIntersect8;
  static constexpr auto occluded = &rtcOccluded8;
};
template <>
struct Packet<16> {
  using Ray = RTCRay16;
  using RayHit = RTCRayHit16;
  static constexpr auto intersect = &rtcIntersect16;
  static constexpr auto occluded = &rtcOccluded16;
};

/// Which of n lanes from `first` on have a ray. Aligned, since Embree may load it with aligned instructions.
template <std::size_t n>
struct alignas(64) ValidLanes {
  int valid[n];
  ValidLanes(std::uint32_t lanes, std::size_t first) {
    for (std::size_t i = 0; i < n; ++i) valid[i] = -static_cast<int>(lanes >> (first + i) & 1u);
  }
};

/// Rays of n lanes from `first` on; lanes without a ray copy what the block holds.
template <std::size_t n>
void fill_packet(typename Packet<n>::Ray& ray, const RayBlock& rays, std::size_t first, const float* t_far) {
  const auto copy = [first](auto& to, const auto& from) { std::memcpy(to, from + first, sizeof to); };
  copy(ray.org_x, rays.origin_x), copy(ray.org_y, rays.origin_y), copy(ray.org_z, rays.origin_z);
  copy(ray.dir_x, rays.direction_x), copy(ray.dir_y, rays.direction_y), copy(ray.dir_z, rays.direction_z);
  copy(ray.id, rays.light);
  std::memcpy(ray.tfar, t_far + first, sizeof ray.tfar);
  for (std::size_t i = 0; i < n; ++i) {
    ray.tnear[i] = 0;
    ray.time[i] = 0;
    ray.mask[i] = 0xFFFFFFFFu;
    ray.flags[i] = 0;
  }
}

/// Ends of the block's lanes, n at a time. `coherent`: the rays are neighbours from one point; others, even towards one
/// light, are quicker without (rays_bench.cpp).
template <std::size_t n>
void intersect_packets(RTCScene scene, const RayBlock& rays, std::uint32_t lanes, bool coherent, BlockEnds& ends) {
  for (std::size_t first = 0; lanes >> first != 0; first += n) {
    const ValidLanes<n> active(lanes, first);
    typename Packet<n>::RayHit query;
    fill_packet<n>(query.ray, rays, first, ends.t);
    for (std::size_t i = 0; i < n; ++i) {
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
#ifdef PHOTONPROOF_EMBREE4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    Packet<n>::intersect(active.valid, scene, &query, &arguments);
#else
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    Packet<n>::intersect(active.valid, scene, &context, &query);
#endif
    const auto copy = [first](auto* to, const auto& from) { std::memcpy(to + first, from, sizeof from); };
    copy(ends.t, query.ray.tfar), copy(ends.u, query.hit.u), copy(ends.v, query.hit.v);
    copy(ends.instance, query.hit.instID[0]), copy(ends.geometry, query.hit.geomID);
    copy(ends.primitive, query.hit.primID);
  }
}

/// The lanes whose rays meet a surface, n at a time.
template <std::size_t n>
std::uint32_t occlude_packets(RTCScene scene, const RayBlock& rays, std::uint32_t lanes, const float* t_far) {
  std::uint32_t met = 0;
  for (std::size_t first = 0; lanes >> first != 0; first += n) {
    const ValidLanes<n> active(lanes, first);
    typename Packet<n>::Ray query;
    fill_packet<n>(query, rays, first, t_far);
#ifdef PHOTONPROOF_EMBREE4
    Packet<n>::occluded(active.valid, scene, &query, nullptr);
#else
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    Packet<n>::occluded(active.valid, scene, &context, &query);
#endif
    for (std::size_t i = 0; i < n; ++i) met |= (query.tfar[i] < 0 ? 1u : 0u) << (first + i);
  }
  return met;
}

/// The packets that a device traces by instructions of their width. Embree may stop the program at wider ones.
class PacketWidths {
 public:
  PacketWidths() = default;
  explicit PacketWidths(RTCDevice device)
      : four_(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) != 0),
        eight_(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0),
        sixteen_(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) {}

  bool any() const { return four_ || eight_ || sixteen_; }
  /// Calls visit<n>() with the narrowest packets that hold all lanes at once, or else the widest. There must be any().
  template <class Visit>
  auto visit_for(std::uint32_t lanes, Visit&& visit) const {
    const bool fits_four = lanes >> 4 == 0, fits_eight = lanes >> 8 == 0;
    if (four_ && (fits_four || !(eight_ || sixteen_))) return visit.template operator()<4>();
    if (eight_ && (fits_eight || !sixteen_)) return visit.template operator()<8>();
    return visit.template operator()<16>();
  }

 private:
  bool four_ = false, eight_ = false, sixteen_ = false;
};

}  // namespace photonproof::inline renderer_rays
