#include "renderer/trace.h"

#ifdef PHOTONPROOF_EMBREE4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace photonproof {
namespace {

constexpr unsigned quad_geometry = 0;
constexpr unsigned sphere_geometry = 1;
constexpr unsigned first_mesh = 2;

/// Quads, spheres and meshes apart, each with the index of its surface. Meshes are geometries of their own.
struct Tables {
  std::vector<const Quad*> quads;
  std::vector<std::uint32_t> quad_surface;
  std::vector<const Sphere*> spheres;
  std::vector<std::uint32_t> sphere_surface;
  std::vector<const Mesh*> meshes;
  std::vector<std::uint32_t> mesh_surface;
};

struct SurfacePoint {
  Vec3f p, normal;
  std::uint32_t surface = no_index;
};

/// The smallest root in [t_near, t_far] of |o + t d - c| = r, or a negative value. Double precision: in float the
/// discriminant of a distant or grazing ray loses all its digits.
double intersect_sphere(const Sphere& sphere, const RTCRay& ray) {
  const Vec3d d{ray.dir_x, ray.dir_y, ray.dir_z};
  const Vec3d to_center = Vec3d(sphere.center) - Vec3d{ray.org_x, ray.org_y, ray.org_z};
  const double a = dot(d, d);
  const double b = dot(d, to_center);
  const Vec3d nearest = to_center - d * (b / a);
  const double radius = sphere.radius;
  const double discriminant = radius * radius - dot(nearest, nearest);
  if (!(discriminant > 0)) return -1;
  const double root = std::sqrt(discriminant / a);
  // A ray that leaves the sphere starts on it as far as single precision can tell, and does not meet it there.
  const double grain = 0x1p-21 * std::max({radius, std::abs(double{sphere.center.x}), std::abs(double{sphere.center.y}),
                                           std::abs(double{sphere.center.z})});
  const double nearest_t = std::max<double>(ray.tnear, grain / std::sqrt(a));
  const double t0 = b / a - root;
  if (t0 >= nearest_t && t0 <= ray.tfar) return t0;
  const double t1 = b / a + root;
  if (t1 >= nearest_t && t1 <= ray.tfar) return t1;
  return -1;
}

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  const Sphere& s = *static_cast<const Tables*>(args->geometryUserPtr)->spheres[args->primID];
  const float r = s.radius * (1 + 0x1p-20f);
  RTCBounds& b = *args->bounds_o;
  b.lower_x = s.center.x - r;
  b.lower_y = s.center.y - r;
  b.lower_z = s.center.z - r;
  b.upper_x = s.center.x + r;
  b.upper_y = s.center.y + r;
  b.upper_z = s.center.z + r;
}

// Called with one ray or with a packet of them.
void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  const Sphere& sphere = *static_cast<const Tables*>(args->geometryUserPtr)->spheres[args->primID];
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const double t = intersect_sphere(sphere, rtcGetRayFromRayN(rays, args->N, i));
    if (t < 0) continue;
    RTCRayN_tfar(rays, args->N, i) = static_cast<float>(t);
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
  const Sphere& sphere = *static_cast<const Tables*>(args->geometryUserPtr)->spheres[args->primID];
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (intersect_sphere(sphere, rtcGetRayFromRayN(args->ray, args->N, i)) >= 0)
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

/// The lanes with a ray that can be traced: Debian's Embree does not ignore invalid rays, so they are filtered here.
std::uint32_t traceable(const RayBlock& rays) {
  std::uint32_t lanes = 0;
  for (std::uint32_t bits = rays.active; bits != 0; bits &= bits - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(bits));
    const float sum = rays.origin_x[i] + rays.origin_y[i] + rays.origin_z[i] + rays.direction_x[i] +
                      rays.direction_y[i] + rays.direction_z[i];
    if (std::isfinite(sum)) lanes |= 1u << i;
  }
  return lanes;
}

RTCRay ray_of_lane(const RayBlock& rays, std::size_t i, float t_far) {
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
          .id = 0,
          .flags = 0};
}

void intersect_one(RTCScene scene, RTCRayHit& query) {
#ifdef PHOTONPROOF_EMBREE4
  rtcIntersect1(scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
}

bool is_occluded(RTCScene scene, RTCRay query) {
#ifdef PHOTONPROOF_EMBREE4
  rtcOccluded1(scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &query);
#endif
  return query.tfar < 0;
}

void intersect_packet(RTCScene scene, const int* valid, RTCRayHit16& query) {
#ifdef PHOTONPROOF_EMBREE4
  rtcIntersect16(valid, scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &query);
#endif
}

bool count_bytes(void* total, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::int64_t>*>(total) += bytes;
  return true;
}

[[noreturn]] void fail(RTCDevice device, const char* what) {
  throw std::runtime_error(std::string("Embree: ") + what + " failed (error " +
                           std::to_string(static_cast<int>(rtcGetDeviceError(device))) + ")");
}

}  // namespace

struct Tracer::Impl {
  Tables tables;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::int64_t> bytes{0};

  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  void attach_quads();
  void attach_spheres();
  void attach_mesh(const Mesh& mesh, unsigned id);
  SurfacePoint locate(unsigned geometry, unsigned primitive, float u, float v, const Vec3f& near) const;
};

void Tracer::Impl::attach_quads() {
  if (tables.quads.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  const std::size_t count = tables.quads.size();
  auto* vertices = static_cast<Vec3f*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), 4 * count));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), count));
  if (vertices == nullptr || indices == nullptr) fail(device, "allocating quads");
  for (std::size_t i = 0; i < count; ++i) {
    const Quad& q = *tables.quads[i];
    vertices[4 * i] = q.corner;
    vertices[4 * i + 1] = q.corner + q.edge_u;
    vertices[4 * i + 2] = q.corner + q.edge_u + q.edge_v;
    vertices[4 * i + 3] = q.corner + q.edge_v;
    for (std::size_t k = 0; k < 4; ++k) indices[4 * i + k] = static_cast<unsigned>(4 * i + k);
  }
  rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, quad_geometry);
  rtcReleaseGeometry(geometry);
}

void Tracer::Impl::attach_spheres() {
  if (tables.spheres.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(tables.spheres.size()));
  rtcSetGeometryUserData(geometry, &tables);
  rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, sphere_intersect);
  rtcSetGeometryOccludedFunction(geometry, sphere_occluded);
  rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, sphere_geometry);
  rtcReleaseGeometry(geometry);
}

void Tracer::Impl::attach_mesh(const Mesh& mesh, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             sizeof(Vec3f), mesh.positions.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.source->triangles.data(), 0,
                             sizeof(TriangleMesh::Triangle), mesh.triangle_count());
  rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

SurfacePoint Tracer::Impl::locate(unsigned geometry, unsigned primitive, float u, float v, const Vec3f& near) const {
  if (geometry == quad_geometry) {
    const Quad& quad = *tables.quads[primitive];
    return {quad.corner + quad.edge_u * u + quad.edge_v * v, quad.normal, tables.quad_surface[primitive]};
  }
  if (geometry == sphere_geometry) {
    const Sphere& sphere = *tables.spheres[primitive];
    const Vec3f along = near - sphere.center;
    const Vec3f p = sphere.center + along * (sphere.radius / length(along));
    return {p, normalize(sphere.normal_at(p)), tables.sphere_surface[primitive]};
  }
  const Mesh& mesh = *tables.meshes[geometry - first_mesh];
  const Vec3f corner = mesh.corner(primitive, 0);
  const Vec3f edge_u = mesh.corner(primitive, 1) - corner;
  const Vec3f edge_v = mesh.corner(primitive, 2) - corner;
  const Vec3f normal = normalize(cross(edge_u, edge_v));
  return {corner + edge_u * u + edge_v * v, mesh.inward ? -normal : normal, tables.mesh_surface[geometry - first_mesh]};
}

Tracer::Tracer(const std::vector<Surface>& surfaces) : impl_(std::make_unique<Impl>()) {
  Tables& tables = impl_->tables;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    if (const auto* quad = std::get_if<Quad>(&surfaces[i].geometry)) {
      tables.quads.push_back(quad);
      tables.quad_surface.push_back(i);
    } else if (const auto* sphere = std::get_if<Sphere>(&surfaces[i].geometry)) {
      tables.spheres.push_back(sphere);
      tables.sphere_surface.push_back(i);
    } else {
      tables.meshes.push_back(&std::get<Mesh>(surfaces[i].geometry));
      tables.mesh_surface.push_back(i);
    }
  }
  impl_->device = rtcNewDevice(nullptr);
  if (impl_->device == nullptr) fail(nullptr, "opening the device");
  rtcSetDeviceMemoryMonitorFunction(impl_->device, count_bytes, &impl_->bytes);
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
  impl_->attach_quads();
  impl_->attach_spheres();
  for (std::size_t i = 0; i < tables.meshes.size(); ++i)
    impl_->attach_mesh(*tables.meshes[i], static_cast<unsigned>(first_mesh + i));
  rtcCommitScene(impl_->scene);
  if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) fail(impl_->device, "building the scene");
}

Tracer::~Tracer() = default;

std::size_t Tracer::bvh_bytes() const { return static_cast<std::size_t>(std::max<std::int64_t>(0, impl_->bytes)); }

void Tracer::intersect(const RayBlock& rays, HitBlock& hits, bool coherent) const {
  const std::uint32_t lanes = traceable(rays);
  std::fill_n(hits.surface, RayBlock::width, no_index);
  const auto store = [&](std::size_t i, unsigned geometry, unsigned primitive, float u, float v, float t) {
    if (geometry == RTC_INVALID_GEOMETRY_ID) return;
    const Vec3f near{rays.origin_x[i] + t * rays.direction_x[i], rays.origin_y[i] + t * rays.direction_y[i],
                     rays.origin_z[i] + t * rays.direction_z[i]};
    const SurfacePoint point = impl_->locate(geometry, primitive, u, v, near);
    hits.p_x[i] = point.p.x;
    hits.p_y[i] = point.p.y;
    hits.p_z[i] = point.p.z;
    hits.normal_x[i] = point.normal.x;
    hits.normal_y[i] = point.normal.y;
    hits.normal_z[i] = point.normal.z;
    hits.surface[i] = point.surface;
  };
  if (coherent && std::popcount(lanes) > 1) {
    RTCRayHit16 query{};
    alignas(64) int valid[16];  // as Embree's packets are: it may load it with aligned instructions
    for (std::size_t i = 0; i < 16; ++i) {
      valid[i] = (lanes >> i & 1u) != 0 ? -1 : 0;
      if (valid[i] == 0) continue;
      query.ray.org_x[i] = rays.origin_x[i];
      query.ray.org_y[i] = rays.origin_y[i];
      query.ray.org_z[i] = rays.origin_z[i];
      query.ray.tnear[i] = 0;
      query.ray.dir_x[i] = rays.direction_x[i];
      query.ray.dir_y[i] = rays.direction_y[i];
      query.ray.dir_z[i] = rays.direction_z[i];
      query.ray.time[i] = 0;
      query.ray.tfar[i] = std::numeric_limits<float>::infinity();
      query.ray.mask[i] = 0xFFFFFFFFu;
      query.ray.flags[i] = 0;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect_packet(impl_->scene, valid, query);
    for (std::size_t i = 0; i < 16; ++i)
      if (valid[i] != 0)
        store(i, query.hit.geomID[i], query.hit.primID[i], query.hit.u[i], query.hit.v[i], query.ray.tfar[i]);
    return;
  }
  for (std::uint32_t bits = lanes; bits != 0; bits &= bits - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(bits));
    RTCRayHit query{};
    query.ray = ray_of_lane(rays, i, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect_one(impl_->scene, query);
    store(i, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar);
  }
}

void Tracer::occluded(const RayBlock& rays, std::uint32_t* blocked) const {
  std::fill_n(blocked, RayBlock::width, 0u);
  for (std::uint32_t bits = traceable(rays); bits != 0; bits &= bits - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(bits));
    blocked[i] = is_occluded(impl_->scene, ray_of_lane(rays, i, segment_end)) ? 1 : 0;
  }
}

std::size_t Tracer::count_hits_alone(const std::vector<RayBlock>& rays) const {
  std::size_t hits = 0;
  for (const RayBlock& block : rays) {
    for (std::uint32_t bits = block.active; bits != 0; bits &= bits - 1) {
      RTCRayHit query{};
      query.ray =
          ray_of_lane(block, static_cast<std::size_t>(std::countr_zero(bits)), std::numeric_limits<float>::infinity());
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      intersect_one(impl_->scene, query);
      if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) ++hits;
    }
  }
  return hits;
}

std::size_t Tracer::count_occluded_alone(const std::vector<RayBlock>& rays) const {
  std::size_t hits = 0;
  for (const RayBlock& block : rays)
    for (std::uint32_t bits = block.active; bits != 0; bits &= bits - 1)
      if (is_occluded(impl_->scene, ray_of_lane(block, static_cast<std::size_t>(std::countr_zero(bits)), segment_end)))
        ++hits;
  return hits;
}

std::string Tracer::embree_version() {
  return std::to_string(RTC_VERSION_MAJOR) + "." + std::to_string(RTC_VERSION_MINOR) + "." +
         std::to_string(RTC_VERSION_PATCH);
}

}  // namespace photonproof
