#include "renderer/rays/embree_ellipsoids.h"

#include <limits>

#include "scenes/base/thread_handoff.h"

namespace photonproof::inline renderer_rays {
namespace {

/// The `id` of rays that take entries: no face of a light has this number. Their context is a TakingContext.
constexpr unsigned takes_entries = 0xFFFFFFFEu;

#ifdef PHOTONPROOF_EMBREE4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

struct TakingContext : QueryContext {
  CloudEntries* entries = nullptr;
};

/// Whether a ray that takes entries passes this one; other rays and entries that it has no place for do not.
bool takes(const RTCRay& ray, QueryContext* context, const CloudEntry& entry) {
  return ray.id == takes_entries && static_cast<TakingContext*>(context)->entries->take(entry);
}

double distance_to(const Ellipsoids::Place& place, const RTCRay& ray) {
  return hit_distance(
      place, {{ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar, OnLight::no});
}

void bounds(const RTCBoundsFunctionArguments* args) {
  takes_over(args->geometryUserPtr);
  const auto& table = *static_cast<const EllipsoidTable*>(args->geometryUserPtr);
  const EllipsoidTable::Owner& owner = table.owner_of(args->primID);
  const ShapeBox box = box_around(owner.ellipsoids->places[args->primID - owner.first]);
  const Vec3f margin = (box.high - box.low) * 0x1p-21f;  // what rounding could leave outside
  const Vec3f low = box.low - margin, high = box.high + margin;
  RTCBounds& b = *args->bounds_o;
  b.lower_x = low.x, b.lower_y = low.y, b.lower_z = low.z;
  b.upper_x = high.x, b.upper_y = high.y, b.upper_z = high.z;
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& table = *static_cast<const EllipsoidTable*>(args->geometryUserPtr);
  const EllipsoidTable::Owner& owner = table.owner_of(args->primID);
  const std::uint32_t number = args->primID - owner.first;
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRay ray = rtcGetRayFromRayN(rays, args->N, i);
    const auto t = static_cast<float>(distance_to(owner.ellipsoids->places[number], ray));
    if (t < 0 || takes(ray, args->context, {t, owner.surface, number})) continue;
    RTCRayN_tfar(rays, args->N, i) = t;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  const auto& table = *static_cast<const EllipsoidTable*>(args->geometryUserPtr);
  const EllipsoidTable::Owner& owner = table.owner_of(args->primID);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRay ray = rtcGetRayFromRayN(args->ray, args->N, i);
    if (distance_to(owner.ellipsoids->places[args->primID - owner.first], ray) >= 0)
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

/// Rejects hits from behind, and entries that a ray takes.
void filter(const RTCFilterFunctionNArguments* args) {
  const auto& shells = *static_cast<const ShellMesh*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRay ray = rtcGetRayFromRayN(args->ray, args->N, i);
    const RTCHit hit = rtcGetHitFromHitN(args->hit, args->N, i);
    const bool is_back = ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z > 0;
    if (is_back || takes(ray, args->context, {ray.tfar, shells.surface, hit.primID / shells.faces})) args->valid[i] = 0;
  }
}

}  // namespace

RTCGeometry ellipsoid_geometry(RTCDevice device, const EllipsoidTable& table) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, table.count);
  rtcSetGeometryUserData(geometry, const_cast<EllipsoidTable*>(&table));  // which the functions above do not change
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occluded);
  hands_over(&table);
  return geometry;
}

void open_backs(RTCGeometry geometry, const ShellMesh& shells) {
  rtcSetGeometryUserData(geometry, const_cast<ShellMesh*>(&shells));
  rtcSetGeometryIntersectFilterFunction(geometry, filter);
  rtcSetGeometryOccludedFilterFunction(geometry, filter);
}

void take_entries(RTCScene scene, RTCRay ray, CloudEntries& entries) {
  RTCRayHit query{};
  query.ray = ray;
  query.ray.id = takes_entries;
  query.ray.tnear = entries.from();
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  TakingContext context{};
  context.entries = &entries;
#ifdef PHOTONPROOF_EMBREE4
  rtcInitRayQueryContext(&context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &query, &arguments);
#else
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
  entries.end_at(query.ray.tfar);
}

}  // namespace photonproof::inline renderer_rays
