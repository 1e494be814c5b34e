#include "renderer/trace.h"

#ifdef PHOTONPROOF_EMBREE4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace photonproof {
namespace {

constexpr unsigned quad_geometry = 0;
constexpr unsigned sphere_geometry = 1;

/// Quads and spheres apart, each with the index of its surface.
struct Tables {
  std::vector<const Quad*> quads;
  std::vector<std::uint32_t> quad_surface;
  std::vector<const Sphere*> spheres;
  std::vector<std::uint32_t> sphere_surface;
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
  const double t0 = b / a - root;
  if (t0 >= ray.tnear && t0 <= ray.tfar) return t0;
  const double t1 = b / a + root;
  if (t1 >= ray.tnear && t1 <= ray.tfar) return t1;
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

void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& ray_hit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const Sphere& sphere = *static_cast<const Tables*>(args->geometryUserPtr)->spheres[args->primID];
  const double t = intersect_sphere(sphere, ray_hit.ray);
  if (t < 0) return;
  ray_hit.ray.tfar = static_cast<float>(t);
  ray_hit.hit.geomID = args->geomID;
  ray_hit.hit.primID = args->primID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const Sphere& sphere = *static_cast<const Tables*>(args->geometryUserPtr)->spheres[args->primID];
  if (intersect_sphere(sphere, ray) >= 0) ray.tfar = -std::numeric_limits<float>::infinity();
}

RTCRay to_embree(const Ray& ray) {
  return {.org_x = ray.origin.x,
          .org_y = ray.origin.y,
          .org_z = ray.origin.z,
          .tnear = ray.t_near,
          .dir_x = ray.direction.x,
          .dir_y = ray.direction.y,
          .dir_z = ray.direction.z,
          .time = 0,
          .tfar = ray.t_far,
          .mask = 0xFFFFFFFFu,
          .id = 0,
          .flags = 0};
}

// Debian's Embree does not ignore invalid rays, so they are filtered here.
bool is_traceable(const Ray& ray) { return is_finite(ray.origin) && is_finite(ray.direction); }

[[noreturn]] void fail(RTCDevice device, const char* what) {
  throw std::runtime_error(std::string("Embree: ") + what + " failed (error " +
                           std::to_string(static_cast<int>(rtcGetDeviceError(device))) + ")");
}

}  // namespace

struct Tracer::Impl {
  Tables tables;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float coordinate_floor = 0;

  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  void attach_quads();
  void attach_spheres();
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

Tracer::Tracer(const std::vector<Surface>& surfaces) : impl_(std::make_unique<Impl>()) {
  Tables& tables = impl_->tables;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    if (const auto* quad = std::get_if<Quad>(&surfaces[i].geometry)) {
      tables.quads.push_back(quad);
      tables.quad_surface.push_back(i);
    } else {
      tables.spheres.push_back(&std::get<Sphere>(surfaces[i].geometry));
      tables.sphere_surface.push_back(i);
    }
  }
  impl_->device = rtcNewDevice(nullptr);
  if (impl_->device == nullptr) fail(nullptr, "opening the device");
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
  impl_->attach_quads();
  impl_->attach_spheres();
  rtcCommitScene(impl_->scene);
  if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) fail(impl_->device, "building the scene");

  RTCBounds bounds{};
  rtcGetSceneBounds(impl_->scene, &bounds);
  const float extent = std::max({std::abs(bounds.lower_x), std::abs(bounds.lower_y), std::abs(bounds.lower_z),
                                 std::abs(bounds.upper_x), std::abs(bounds.upper_y), std::abs(bounds.upper_z)});
  // A point near the coordinate origin still comes out of arithmetic with the scene's coordinates.
  impl_->coordinate_floor = std::isfinite(extent) ? extent / 16 : 1;
}

Tracer::~Tracer() = default;

Hit Tracer::intersect(const Ray& ray) const {
  Hit hit;
  if (!is_traceable(ray)) return hit;
  RTCRayHit query{.ray = to_embree(ray), .hit = {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#ifdef PHOTONPROOF_EMBREE4
  rtcIntersect1(impl_->scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  const Tables& tables = impl_->tables;
  if (query.hit.geomID == quad_geometry) {
    const Quad& quad = *tables.quads[query.hit.primID];
    hit.surface = tables.quad_surface[query.hit.primID];
    hit.p_world = quad.corner + quad.edge_u * query.hit.u + quad.edge_v * query.hit.v;
    hit.normal = quad.normal;
  } else {
    const Sphere& sphere = *tables.spheres[query.hit.primID];
    hit.surface = tables.sphere_surface[query.hit.primID];
    const Vec3f along = ray.origin + ray.direction * query.ray.tfar - sphere.center;
    hit.p_world = sphere.center + along * (sphere.radius / length(along));
    hit.normal = normalize(sphere.normal_at(hit.p_world));
  }
  return hit;
}

bool Tracer::occluded(const Ray& ray) const {
  if (!is_traceable(ray)) return false;
  RTCRay query = to_embree(ray);
#ifdef PHOTONPROOF_EMBREE4
  rtcOccluded1(impl_->scene, &query, nullptr);
#else
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene, &context, &query);
#endif
  return query.tfar < 0;
}

Vec3f Tracer::offset(const Vec3f& p_world, const Vec3f& normal, const Vec3f& towards) const {
  const float magnitude =
      std::max({std::abs(p_world.x), std::abs(p_world.y), std::abs(p_world.z), impl_->coordinate_floor});
  const float distance = 4 * 0x1p-23f * magnitude;
  return p_world + normal * (dot(normal, towards) >= 0 ? distance : -distance);
}

std::string Tracer::embree_version() {
  return std::to_string(RTC_VERSION_MAJOR) + "." + std::to_string(RTC_VERSION_MINOR) + "." +
         std::to_string(RTC_VERSION_PATCH);
}

}  // namespace photonproof
