#include "harness/stress/stress_scene.h"

#include <filesystem>
#include <mutex>
#include <set>

#include "scenes/meshes/ply.h"

namespace photonproof::inline harness_stress {

BsdfIndex add_bsdf(SceneDescription& scene, const BsdfModel& model) {
  scene.bsdfs.push_back({{}, "bsdf" + std::to_string(scene.bsdfs.size()), model});
  return {static_cast<std::uint32_t>(scene.bsdfs.size() - 1)};
}

ShapeDescription& add_shape(SceneDescription& scene, const Geometry& geometry, const Transform& to_world,
                            BsdfIndex bsdf) {
  ShapeDescription shape;
  shape.geometry = geometry;
  shape.to_world = to_world;
  shape.bsdf = bsdf;
  scene.shapes.push_back(shape);
  return scene.shapes.back();
}

Transform standing(const Vec3d& at, double size) { return Transform::translate(at) * Transform::scale(Vec3d(size)); }

Transform lying(const Vec3d& at, double size) { return standing(at, size) * Transform::rotate({1, 0, 0}, -90); }

Transform hanging(const Vec3d& at, double size) { return standing(at, size) * Transform::rotate({1, 0, 0}, 90); }

SceneDescription empty_stress_scene() {
  SceneDescription scene;
  PerspectiveDescription camera;
  camera.fov_degrees = 32;
  scene.sensor.camera = camera;
  scene.sensor.to_world = Transform::look_at({0, 7, 5}, {0, 0.3, 0}, {0, 1, 0});
  scene.sensor.film.width = scene.sensor.film.height = 24;
  return scene;
}

SceneDescription stress_scene_floor() {
  SceneDescription scene = empty_stress_scene();
  const BsdfIndex grey = add_bsdf(scene, DiffuseDescription{});
  add_shape(scene, RectangleDescription{}, lying({0, 0, 0}, 8), grey);
  return scene;
}

SceneDescription lit_stress_scene() {
  SceneDescription scene = stress_scene_floor();
  const BsdfIndex black = add_bsdf(scene, DiffuseDescription{RgbD(0.0)});
  add_shape(scene, RectangleDescription{}, hanging({1, 5, -1}, 1), black).radiance = RgbD(6);
  return scene;
}

SceneDescription stress_scene_with_bsdf(const BsdfModel& model) {
  SceneDescription scene = lit_stress_scene();
  scene.textures.push_back({{}, "squares", CheckerboardDescription{RgbD(0.7), RgbD(0.3), Transform::scale(Vec3d(8))}});
  std::get<DiffuseDescription>(scene.bsdfs[0].model).reflectance = TextureIndex{0};
  const BsdfIndex own = add_bsdf(scene, model);
  add_shape(scene, SphereDescription{}, standing({0, 1, 0}, 1), own);
  return scene;
}

SceneDescription stress_scene_under(const Light& light) {
  SceneDescription scene = stress_scene_floor();
  add_shape(scene, SphereDescription{}, standing({-0.5, 0.7, 0}, 0.7), {0});
  scene.emitters.push_back({{}, "", light});
  return scene;
}

SceneDescription stress_scene_under_shape(const Geometry& geometry, const Transform& to_world, double radiance) {
  SceneDescription scene = stress_scene_floor();
  add_shape(scene, SphereDescription{}, standing({-0.5, 0.7, 0}, 0.7), {0});
  const BsdfIndex black = add_bsdf(scene, DiffuseDescription{RgbD(0.0)});
  add_shape(scene, geometry, to_world, black).radiance = RgbD(radiance);
  return scene;
}

SceneDescription closed_sphere(double emission, double albedo) {
  SceneDescription scene = empty_stress_scene();
  ShapeDescription& wall = add_shape(scene, SphereDescription{}, {}, add_bsdf(scene, DiffuseDescription{RgbD(albedo)}));
  wall.flip_normals = true;
  wall.radiance = RgbD(emission);
  PerspectiveDescription camera;
  camera.fov_degrees = 90;
  scene.sensor.camera = camera;
  scene.sensor.to_world = Transform::look_at({0.2, 0.1, -0.3}, {0.4, -0.2, 1}, {0, 1, 0});
  return scene;
}

SceneDescription ball_in_uniform_sky(const BsdfModel& model) {
  SceneDescription scene = empty_stress_scene();
  add_shape(scene, SphereDescription{}, standing({0, 0.3, 0}, 1), add_bsdf(scene, model));
  scene.emitters.push_back({{}, "", ConstantLightDescription{}});
  return scene;
}

TriangleMesh mesh_of(const std::vector<Vec3f>& positions, const std::vector<TriangleMesh::Triangle>& triangles) {
  TriangleMesh mesh;
  mesh.positions = positions;
  mesh.resize_positions(positions.size());
  mesh.triangles = triangles;
  return mesh;
}

namespace {

/// Sweeps of several engines run at the same time and share meshes.
void write_once(const std::filesystem::path& file, const TriangleMesh& mesh) {
  static std::mutex writing;
  static std::set<std::filesystem::path> written;
  const std::scoped_lock lock(writing);
  if (written.contains(file) && std::filesystem::exists(file)) return;
  write_ply(file, mesh);
  written.insert(file);
}

}  // namespace

MeshDescription mesh_file(const std::filesystem::path& folder, const std::string& name, TriangleMesh mesh) {
  const std::filesystem::path file = std::filesystem::absolute(folder / (name + ".ply"));
  write_once(file, mesh);
  MeshDescription description;
  description.filename = file.string();
  description.face_normals = true;
  description.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return description;
}

}  // namespace photonproof::inline harness_stress
