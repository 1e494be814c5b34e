#include "renderer/rays/trace.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "renderer/rays/embree.h"
#include "renderer/rays/embree_curves.h"
#include "renderer/rays/embree_ellipsoids.h"
#include "renderer/rays/embree_queries.h"
#include "renderer/rays/mesh_hits.h"
#include "renderer/rays/trace_tables.h"
#include "scenes/base/thread_handoff.h"

namespace photonproof::inline renderer_rays {
namespace {

constexpr unsigned quad_geometry = 0;
constexpr unsigned first_solved = 1;  // a geometry a table
constexpr unsigned first_curves =
    first_solved + std::tuple_size_v<decltype(TraceTables::solved)>;  // a geometry a basis
constexpr unsigned ellipsoids_geometry = first_curves + std::tuple_size_v<decltype(TraceTables::curves)>;
constexpr unsigned first_mesh = ellipsoids_geometry + 1;  // then the instances

/// Calls visit(table, number of its geometry) for every table of solved shapes.
template <class Solved, class Visit>
void for_each_solved(Solved& solved, Visit&& visit) {
  unsigned id = first_solved;
  std::apply([&](auto&... table) { (visit(table, id++), ...); }, solved);
}

struct SurfacePoint {
  Vec3f p, normal;
  std::uint32_t surface = no_index;
  std::uint32_t primitive = 0;
};

/// The ray as passed to a shape, which may be this light's face.
ShapeRay shape_ray(const RTCRay& ray, std::uint32_t light = no_index) {
  const bool on_light = (ray.id & ~light_at_end) == light, at_end = (ray.id & light_at_end) != 0;
  return {{ray.org_x, ray.org_y, ray.org_z},
          {ray.dir_x, ray.dir_y, ray.dir_z},
          ray.tnear,
          ray.tfar,
          !on_light ? OnLight::no
          : at_end  ? OnLight::ends
                    : OnLight::starts};
}

template <class Shape>
void bounds_callback(const RTCBoundsFunctionArguments* args) {
  takes_over(args->geometryUserPtr);
  const ShapeBox box = box_around(*static_cast<const ShapeTable<Shape>*>(args->geometryUserPtr)->shapes[args->primID]);
  const Vec3f margin = (box.high - box.low) * 0x1p-21f;  // what rounding could leave outside
  const Vec3f low = box.low - margin, high = box.high + margin;
  RTCBounds& b = *args->bounds_o;
  b.lower_x = low.x;
  b.lower_y = low.y;
  b.lower_z = low.z;
  b.upper_x = high.x;
  b.upper_y = high.y;
  b.upper_z = high.z;
}

// Called with one ray or with a packet of them.
template <class Shape>
void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  const auto& table = *static_cast<const ShapeTable<Shape>*>(args->geometryUserPtr);
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRay ray = rtcGetRayFromRayN(rays, args->N, i);
    const double t = hit_distance(*table.shapes[args->primID], shape_ray(ray, table.light[args->primID]));
    if (t < 0) continue;
    RTCRayN_tfar(rays, args->N, i) = static_cast<float>(t);
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
}

template <class Shape>
void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  const auto& table = *static_cast<const ShapeTable<Shape>*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRay ray = rtcGetRayFromRayN(args->ray, args->N, i);
    if (hit_distance(*table.shapes[args->primID], shape_ray(ray, table.light[args->primID])) >= 0)
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

bool count_bytes(void* total, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::int64_t>*>(total) += bytes;
  return true;
}

[[noreturn]] void fail(RTCError error, const char* what) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error(std::string("Embree: ") + what + " failed (error " +
                           std::to_string(static_cast<int>(error)) + ")");
}

}  // namespace

struct Tracer::Impl {
  TraceTables tables;
  std::vector<RTCScene> groups;  ///< hierarchies, built once for all instances
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  PacketWidths widths;
  bool packets_pay = false;
  std::atomic<std::int64_t> bytes{0};

  explicit Impl(const std::vector<Surface>& surfaces) : tables(surfaces) {}
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    for (RTCScene group : groups) rtcReleaseScene(group);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  RTCScene new_scene() const;
  /// Hands the geometry over.
  static void attach(RTCScene to, RTCGeometry geometry, unsigned id);
  void attach_quads();
  template <class Shape>
  void attach_shapes(ShapeTable<Shape>& table, unsigned id);
  /// Its long faces, which are in a table of their own, and those without area. Rays never meet the latter, but would
  /// be tested against their boxes.
  static std::vector<std::size_t> faces_to_leave_out(const Mesh& mesh, const std::vector<LongFace>* long_faces);
  void attach_mesh(RTCScene to, const Mesh& mesh, const std::vector<LongFace>* long_faces, const ShellMesh* shells,
                   unsigned id) const;
  void build_group(const MeshGroup& group);
  void attach_instance(const PlacedGroup& instance, unsigned id);

  unsigned first_instance() const { return first_mesh + static_cast<unsigned>(tables.meshes.shapes.size()); }
  bool is_mesh(unsigned instance, unsigned geometry) const {
    return instance == RTC_INVALID_GEOMETRY_ID && geometry >= first_mesh && geometry < first_instance();
  }
  /// Whether the rays go together. A ray ends at the same bits in a packet as alone, except on curves. Packets are
  /// slower among balls and other shapes that Embree does not have.
  bool takes_packets(std::uint32_t lanes, bool coherent) const {
    return lanes != 0 && !std::has_single_bit(lanes) && widths.any() && (coherent || packets_pay);
  }
  std::uint32_t occlude_packets(const RayBlock& rays, std::uint32_t lanes) const;
  /// The plane that the ray meets first before its end, which moves there; no_index if none.
  std::uint32_t meet_planes(RTCRay& ray) const;
  SurfacePoint locate(unsigned instance, unsigned geometry, unsigned primitive, float u, float v,
                      const Vec3d& near) const;
  /// Writes the lane's end, which may be on a plane.
  void locate(const RayBlock& rays, const BlockEnds& ends, std::size_t lane, std::uint32_t plane, HitBlock& hits) const;
};

RTCScene Tracer::Impl::new_scene() const {
  RTCScene made = rtcNewScene(device);
  rtcSetSceneFlags(made, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(made, RTC_BUILD_QUALITY_MEDIUM);
  return made;
}

void Tracer::Impl::attach(RTCScene to, RTCGeometry geometry, unsigned id) {
  rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(to, geometry, id);
  rtcReleaseGeometry(geometry);
}

void Tracer::Impl::attach_quads() {
  if (tables.quads.shapes.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  const std::size_t count = tables.quads.shapes.size();
  auto* vertices = static_cast<Vec3f*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), 4 * count));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), count));
  if (vertices == nullptr || indices == nullptr) fail(rtcGetDeviceError(device), "allocating quads");
  for (std::size_t i = 0; i < count; ++i) {
    const Quad& q = *tables.quads.shapes[i];
    vertices[4 * i] = q.corner;
    vertices[4 * i + 1] = q.corner + q.edge_u;
    vertices[4 * i + 2] = q.corner + q.edge_u + q.edge_v;
    vertices[4 * i + 3] = q.corner + q.edge_v;
    for (std::size_t k = 0; k < 4; ++k) indices[4 * i + k] = static_cast<unsigned>(4 * i + k);
  }
  attach(scene, geometry, quad_geometry);
}

template <class Shape>
void Tracer::Impl::attach_shapes(ShapeTable<Shape>& table, unsigned id) {
  if (table.shapes.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(table.shapes.size()));
  rtcSetGeometryUserData(geometry, &table);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback<Shape>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback<Shape>);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback<Shape>);
  hands_over(&table);
  attach(scene, geometry, id);
}

std::vector<std::size_t> Tracer::Impl::faces_to_leave_out(const Mesh& mesh, const std::vector<LongFace>* long_faces) {
  std::vector<std::size_t> left_out;
  if (long_faces != nullptr)
    for (const LongFace& face : *long_faces) left_out.push_back(face.primitive);
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i)
    if (!has_area(mesh.positions, mesh.source->triangles[i])) left_out.push_back(i);
  return left_out;
}

void Tracer::Impl::attach_mesh(RTCScene to, const Mesh& mesh, const std::vector<LongFace>* long_faces,
                               const ShellMesh* shells, unsigned id) const {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             sizeof(Vec3f), mesh.positions.size() - 1);
  constexpr std::size_t stride = sizeof(TriangleMesh::Triangle);
  const std::vector<std::size_t> left_out = faces_to_leave_out(mesh, long_faces);
  if (left_out.empty()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.source->triangles.data(), 0,
                               stride, mesh.triangle_count());
  } else {
    auto* triangles = static_cast<TriangleMesh::Triangle*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, stride, mesh.triangle_count()));
    if (triangles == nullptr) fail(rtcGetDeviceError(device), "allocating triangles");
    std::copy(mesh.source->triangles.begin(), mesh.source->triangles.end(), triangles);
    // Embree builds no boxes for faces with invalid vertex indices.
    for (const std::size_t face : left_out) triangles[face].fill(std::numeric_limits<std::uint32_t>::max());
  }
  if (shells != nullptr && shells->faces > 0) open_backs(geometry, *shells);
  attach(to, geometry, id);
}

void Tracer::Impl::build_group(const MeshGroup& group) {
  groups.push_back(new_scene());
  for (std::size_t part = 0; part < group.parts.size(); ++part)
    attach_mesh(groups.back(), *group.parts[part], nullptr, nullptr, static_cast<unsigned>(part));
  rtcCommitScene(groups.back());
}

void Tracer::Impl::attach_instance(const PlacedGroup& instance, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, groups[instance.group]);
  rtcSetGeometryTimeStepCount(geometry, 1);
  const AffineMap& m = *instance.placement;
  const float columns[12] = {m.x.x, m.x.y, m.x.z, m.y.x,      m.y.y,      m.y.z,
                             m.z.x, m.z.y, m.z.z, m.origin.x, m.origin.y, m.origin.z};
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  attach(scene, geometry, id);
}

std::uint32_t Tracer::Impl::meet_planes(RTCRay& ray) const {
  std::uint32_t met = no_index;
  for (std::uint32_t i = 0; i < tables.planes.shapes.size(); ++i) {
    const double t = hit_distance(*tables.planes.shapes[i], shape_ray(ray));
    if (t < 0) continue;
    ray.tfar = static_cast<float>(t);
    met = i;
  }
  return met;
}

SurfacePoint Tracer::Impl::locate(unsigned instance, unsigned geometry, unsigned primitive, float u, float v,
                                  const Vec3d& near) const {
  const auto on_mesh = [&](const Mesh& mesh, std::uint32_t surface) -> SurfacePoint {
    const OnTriangle at = on_triangle(mesh, primitive, u, v);
    return {at.p, at.normal, surface, primitive};
  };
  if (instance != RTC_INVALID_GEOMETRY_ID) {
    const PlacedGroup& copy = tables.instances[instance - first_instance()];
    SurfacePoint point = on_mesh(*tables.groups[copy.group].parts[geometry], copy.surface[geometry]);
    point.p = copy.placement->point(point.p);
    point.normal = normalize(copy.placement->normal(point.normal));
    return point;
  }
  if (geometry == quad_geometry) {
    const Quad& quad = *tables.quads.shapes[primitive];
    return {quad.corner + quad.edge_u * u + quad.edge_v * v, quad.normal, tables.quads.surface[primitive]};
  }
  if (geometry >= first_mesh)
    return on_mesh(*tables.meshes.shapes[geometry - first_mesh], tables.meshes.surface[geometry - first_mesh]);
  if (geometry == ellipsoids_geometry) {
    const EllipsoidTable::Owner& owner = tables.ellipsoids.owner_of(primitive);
    const ShapePoint point = point_on(*owner.ellipsoids, primitive - owner.first, near);
    return {point.p, point.normal, owner.surface, primitive - owner.first};
  }
  if (geometry >= first_curves) {
    const CurveTable::Owner& owner = tables.curves[geometry - first_curves].owner_of(primitive);
    const ShapePoint point = point_on(*owner.curves, primitive - owner.first, double{u}, near);
    return {point.p, point.normal, owner.surface, primitive - owner.first};
  }
  SurfacePoint found;
  for_each_solved(tables.solved, [&](const auto& table, unsigned id) {
    if (id != geometry) return;
    const auto& shape = *table.shapes[primitive];
    const ShapePoint point = point_on(shape, near);
    found = {point.p, point.normal, table.surface[primitive]};
    if constexpr (requires { shape.primitive; }) found.primitive = shape.primitive;
  });
  return found;
}

void Tracer::Impl::locate(const RayBlock& rays, const BlockEnds& ends, std::size_t i, std::uint32_t plane,
                          HitBlock& hits) const {
  const unsigned geometry = ends.geometry[i];
  if (geometry == RTC_INVALID_GEOMETRY_ID && plane == no_index) return;
  const Vec3d near = Vec3d{rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]} +
                     Vec3d{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]} * double{ends.t[i]};
  SurfacePoint point;
  if (geometry != RTC_INVALID_GEOMETRY_ID) {
    point = locate(ends.instance[i], geometry, ends.primitive[i], ends.u[i], ends.v[i], near);
  } else {
    const ShapePoint on_plane = point_on(*tables.planes.shapes[plane], near);
    point = {on_plane.p, on_plane.normal, tables.planes.surface[plane]};
  }
  hits.p_x[i] = point.p.x;
  hits.p_y[i] = point.p.y;
  hits.p_z[i] = point.p.z;
  hits.normal_x[i] = point.normal.x;
  hits.normal_y[i] = point.normal.y;
  hits.normal_z[i] = point.normal.z;
  hits.surface[i] = point.surface;
  hits.primitive[i] = point.primitive;
}

std::uint32_t Tracer::Impl::occlude_packets(const RayBlock& rays, std::uint32_t lanes) const {
  float t_far[RayBlock::width];
  std::fill_n(t_far, RayBlock::width, segment_end);
  return widths.visit_for(
      lanes, [&]<std::size_t n>() { return renderer_rays::occlude_packets<n>(scene, rays, lanes, t_far); });
}

Tracer::Tracer(const std::vector<Surface>& surfaces) : impl_(std::make_unique<Impl>(surfaces)) {
  TraceTables& tables = impl_->tables;
  impl_->device = rtcNewDevice(nullptr);
  if (impl_->device == nullptr) fail(rtcGetDeviceError(nullptr), "opening the device");
  rtcSetDeviceMemoryMonitorFunction(impl_->device, count_bytes, &impl_->bytes);
  impl_->widths = PacketWidths(impl_->device);
  impl_->packets_pay = tables.is_flat();
  impl_->scene = impl_->new_scene();
  impl_->attach_quads();
  for_each_solved(tables.solved, [&](auto& table, unsigned id) { impl_->attach_shapes(table, id); });
  for (unsigned i = 0; i < tables.curves.size(); ++i)
    if (const CurveTable& table = tables.curves[i]; !table.segments.empty())
      Impl::attach(impl_->scene, curve_geometry(impl_->device, table), first_curves + i);
  if (tables.ellipsoids.count > 0)
    Impl::attach(impl_->scene, ellipsoid_geometry(impl_->device, tables.ellipsoids), ellipsoids_geometry);
  for (std::size_t i = 0; i < tables.meshes.shapes.size(); ++i)
    impl_->attach_mesh(impl_->scene, *tables.meshes.shapes[i], tables.long_faces_of_mesh[i], &tables.shells_of_mesh[i],
                       static_cast<unsigned>(first_mesh + i));
  for (const MeshGroup& group : tables.groups) impl_->build_group(group);
  for (std::size_t i = 0; i < tables.instances.size(); ++i)
    impl_->attach_instance(tables.instances[i], static_cast<unsigned>(impl_->first_instance() + i));
  rtcCommitScene(impl_->scene);
  // Reading an error clears it.
  if (const RTCError error = rtcGetDeviceError(impl_->device); error != RTC_ERROR_NONE)
    fail(error, "building the scene");
}

Tracer::~Tracer() = default;

std::size_t Tracer::bvh_bytes() const { return static_cast<std::size_t>(std::max<std::int64_t>(0, impl_->bytes)); }

void Tracer::intersect(const RayBlock& rays, HitBlock& hits, bool coherent) const {
  const std::uint32_t lanes = traceable(rays);
  std::fill_n(hits.surface, RayBlock::width, no_index);
  if (lanes == 0) return;
  BlockEnds ends;
  std::fill_n(ends.t, RayBlock::width, std::numeric_limits<float>::infinity());
  std::uint32_t plane[RayBlock::width];
  std::fill_n(plane, RayBlock::width, no_index);
  for_each_lane(impl_->tables.planes.shapes.empty() ? 0 : lanes, [&](std::size_t i) {
    RTCRay ray = ray_of_lane(rays, i, ends.t[i]);
    plane[i] = impl_->meet_planes(ray);
    ends.t[i] = ray.tfar;
  });
  if (impl_->takes_packets(lanes, coherent))
    impl_->widths.visit_for(lanes,
                            [&]<std::size_t n>() { intersect_packets<n>(impl_->scene, rays, lanes, coherent, ends); });
  else
    for_each_lane(lanes, [&](std::size_t i) { intersect_one(impl_->scene, rays, i, ends); });

  MeshHits on_meshes;
  std::uint32_t others = 0;
  for_each_lane(lanes, [&](std::size_t i) {
    const unsigned geometry = ends.geometry[i];
    if (!impl_->is_mesh(ends.instance[i], geometry)) {
      others |= 1u << i;
      return;
    }
    on_meshes.add(i, *impl_->tables.meshes.shapes[geometry - first_mesh], ends.primitive[i]);
    hits.surface[i] = impl_->tables.meshes.surface[geometry - first_mesh];
    hits.primitive[i] = ends.primitive[i];
  });
  on_meshes.locate(ends.u, ends.v, hits);  // before the others: it overwrites their lanes
  for_each_lane(others, [&](std::size_t i) { impl_->locate(rays, ends, i, plane[i], hits); });
}

void Tracer::occluded(const RayBlock& rays, std::uint32_t* blocked) const {
  const std::uint32_t lanes = traceable(rays);
  std::uint32_t hidden = 0;
  for_each_lane(impl_->tables.planes.shapes.empty() ? 0 : lanes, [&](std::size_t i) {
    RTCRay ray = ray_of_lane(rays, i, segment_end);
    if (impl_->meet_planes(ray) != no_index) hidden |= 1u << i;
  });
  const std::uint32_t open = lanes & ~hidden;
  if (impl_->takes_packets(open, false))
    hidden |= impl_->occlude_packets(rays, open);
  else
    for_each_lane(open, [&](std::size_t i) { hidden |= is_occluded(impl_->scene, rays, i) ? 1u << i : 0; });
  for (std::size_t i = 0; i < RayBlock::width; ++i) blocked[i] = hidden >> i & 1u;
}

void Tracer::take_entries(const Vec3f& origin, const Vec3f& direction, CloudEntries& entries) const {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = 0xFFFFFFFFu;
  impl_->meet_planes(ray);
  renderer_rays::take_entries(impl_->scene, ray, entries);
}

std::size_t Tracer::count_hits_alone(const std::vector<RayBlock>& rays, Alone how) const {
  const bool packets = how != Alone::one_by_one && impl_->widths.any();
  std::size_t hits = 0;
  BlockEnds ends;
  for (const RayBlock& block : rays) {
    std::fill_n(ends.t, RayBlock::width, std::numeric_limits<float>::infinity());
    if (packets)
      impl_->widths.visit_for(block.active, [&]<std::size_t n>() {
        intersect_packets<n>(impl_->scene, block, block.active, how == Alone::as_neighbours, ends);
      });
    else
      for_each_lane(block.active, [&](std::size_t i) { intersect_one(impl_->scene, block, i, ends); });
    for_each_lane(block.active, [&](std::size_t i) { hits += ends.geometry[i] != RTC_INVALID_GEOMETRY_ID ? 1 : 0; });
  }
  return hits;
}

std::size_t Tracer::count_occluded_alone(const std::vector<RayBlock>& rays, Alone how) const {
  const bool packets = how != Alone::one_by_one && impl_->widths.any();
  std::size_t hits = 0;
  for (const RayBlock& block : rays) {
    if (packets)
      hits += static_cast<std::size_t>(std::popcount(impl_->occlude_packets(block, block.active)));
    else
      for_each_lane(block.active, [&](std::size_t i) { hits += is_occluded(impl_->scene, block, i) ? 1 : 0; });
  }
  return hits;
}

}  // namespace photonproof::inline renderer_rays
