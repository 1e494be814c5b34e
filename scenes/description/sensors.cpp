#include "scenes/description/sensors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/base/bounds.h"

namespace photonproof::inline scenes_description {
namespace {

using Box = Bounds3d;

/// A box around the transformed box.
Box transformed(const Box& box, const Transform& t) {
  Box result;
  if (box.empty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.add(t.point({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                        corner & 4 ? box.high.z : box.low.z}));
  return result;
}

/// The box of a shape in its local space.
struct LocalBox {
  const SceneDescription& scene;

  Box operator()(const SphereDescription& d) const { return {d.center - Vec3d(d.radius), d.center + Vec3d(d.radius)}; }
  Box operator()(const RectangleDescription&) const { return {{-1, -1, 0}, {1, 1, 0}}; }
  Box operator()(const DiskDescription&) const { return {{-1, -1, 0}, {1, 1, 0}}; }
  Box operator()(const CubeDescription&) const { return {Vec3d(-1.0), Vec3d(1.0)}; }
  Box operator()(const CylinderDescription& d) const {
    Box box;
    for (const Vec3d& end : {d.p0, d.p1}) {
      box.add(end - Vec3d(d.radius));
      box.add(end + Vec3d(d.radius));
    }
    return box;
  }
  Box operator()(const PlaneDescription&) const { return {}; }
  Box operator()(const MeshDescription& d) const {
    Box box;
    for (const Vec3f& p : d.mesh->positions) box.add(Vec3d(p));
    return box;
  }
  Box operator()(const HeightfieldDescription& d) const {
    const double height = std::abs(d.amplitude);
    return {{-1, -1, -height}, {1, 1, height}};
  }
  Box operator()(const CurvesDescription& d) const {
    Box box;
    for (const CurvePoint& point : d.curves->points) box.add(Vec3d(point.p));
    return box;
  }
  Box operator()(const SdfGridDescription&) const { return {Vec3d(0.0), Vec3d(1.0)}; }
  Box operator()(const EllipsoidsDescription& d) const {
    Box box;
    for (std::size_t i = 0; i < d.cloud->ellipsoids.size(); ++i) {
      const Ellipsoid& e = d.cloud->ellipsoids[i];
      const double widest = std::max({double{e.scale.x}, double{e.scale.y}, double{e.scale.z}});
      const Vec3d center(e.center), most(widest * d.scale_factor * d.reach(i));
      box.add(center - most);
      box.add(center + most);
    }
    return box;
  }
  Box operator()(const InstanceDescription& d) const { return box_of(scene.groups[d.group.value].shapes); }

  Box box_of(const std::vector<ShapeDescription>& shapes) const {
    Box all;
    for (const ShapeDescription& shape : shapes) {
      const Box box = transformed(std::visit(*this, shape.geometry), shape.to_world);
      if (box.empty()) continue;
      all.add(box.low);
      all.add(box.high);
    }
    return all;
  }
};

}  // namespace

SensorDescription sensor_around(const SceneDescription& scene, bool front) {
  Box box = LocalBox{scene}.box_of(scene.shapes);
  if (box.empty()) box = {Vec3d(-1.0), Vec3d(1.0)};
  const double across = max_component(box.high - box.low), extent = across > 0 ? across : 1;
  const double distance = extent / (2 * std::tan(std::numbers::pi / 8));
  const Vec3d centre = (box.low + box.high) * 0.5;
  SensorDescription sensor;
  PerspectiveDescription camera;
  camera.fov_degrees = 45;
  camera.fov_axis = FovAxis::smaller;
  camera.near_clip = distance / 100;
  camera.far_clip = extent * 5 + distance;
  sensor.camera = camera;
  const Vec3d eye{centre.x, centre.y, front ? box.high.z + distance : box.low.z - distance};
  sensor.to_world = Transform::look_at(eye, {centre.x, centre.y, centre.z}, {0, 1, 0});
  sensor.film.filter = {ReconstructionFilter::Kind::gaussian};
  return sensor;
}

bool is_meter(const SensorDescription& sensor) {
  return std::holds_alternative<RadianceMeterDescription>(sensor.camera) ||
         std::holds_alternative<IrradianceMeterDescription>(sensor.camera) ||
         std::holds_alternative<DistantDescription>(sensor.camera);
}

std::string film_problem(const SensorDescription& sensor) {
  const std::string size = std::to_string(sensor.film.width) + " x " + std::to_string(sensor.film.height) + " pixels";
  if (const auto* batch = std::get_if<BatchDescription>(&sensor.camera)) {
    const int views = static_cast<int>(batch->views.size());
    if (sensor.film.width % views != 0)
      return "has " + std::to_string(views) + " cameras and a film of " + size +
             ", expected a width that is a multiple of " + std::to_string(views);
  }
  if (is_meter(sensor) && (sensor.film.width != 1 || sensor.film.height != 1))
    return "has a film of " + size + ", expected 1 x 1";
  return "";
}

}  // namespace photonproof::inline scenes_description
