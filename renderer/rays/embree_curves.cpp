#include "renderer/rays/embree_curves.h"

#include "scenes/base/thread_handoff.h"

namespace photonproof::inline renderer_rays {
namespace {

/// Rejects hits from inside.
void front_filter(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRay ray = rtcGetRayFromRayN(args->ray, args->N, i);
    const RTCHit hit = rtcGetHitFromHitN(args->hit, args->N, i);
    if (ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z > 0) args->valid[i] = 0;
  }
}

}  // namespace

RTCGeometry curve_geometry(RTCDevice device, const CurveTable& table) {
  static_assert(sizeof(CurvePoint) == 4 * sizeof(float));
  const bool linear = table.owners.front().curves->linear;
  RTCGeometry geometry =
      rtcNewGeometry(device, linear ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE : RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, table.points.data(), 0,
                             sizeof(CurvePoint), table.points.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, table.segments.data(), 0,
                             sizeof(std::uint32_t), table.segments.size());
  rtcSetGeometryIntersectFilterFunction(geometry, front_filter);
  rtcSetGeometryOccludedFilterFunction(geometry, front_filter);
  return geometry;
}

}  // namespace photonproof::inline renderer_rays
