// Scenes in which a surface has more than one tangent plane, or is thinner than a gather's width.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "scenes/meshes/icosphere.h"

namespace photonproof::test {

inline MeshDescription mesh_of(const std::vector<Vec3f>& positions, std::vector<TriangleMesh::Triangle> triangles,
                               bool face_normals, const std::vector<Vec2<float>>& uvs = {}) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(positions.size());
  std::copy(positions.begin(), positions.end(), mesh->positions.begin());
  mesh->triangles = std::move(triangles);
  mesh->uvs = uvs;
  return {MeshDescription::Format::obj, "made.obj", face_normals, false, mesh};
}

/// The box [-1,1]^3 as a mesh of twelve triangles that face outward and share their corners.
inline MeshDescription box_mesh() {
  std::vector<Vec3f> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  return mesh_of(corners,
                 {{0, 2, 3},
                  {0, 3, 1},
                  {4, 5, 7},
                  {4, 7, 6},
                  {0, 1, 5},
                  {0, 5, 4},
                  {2, 6, 7},
                  {2, 7, 3},
                  {0, 4, 6},
                  {0, 6, 2},
                  {1, 3, 7},
                  {1, 7, 5}},
                 true);
}

/// The square [-1,1]^2 facing +z, cut into cells^2 squares of two triangles, with uv over it.
inline MeshDescription square_mesh(int cells) {
  std::vector<Vec3f> positions;
  std::vector<Vec2<float>> uvs;
  std::vector<TriangleMesh::Triangle> triangles;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const Vec2<float> uv{static_cast<float>(x) / static_cast<float>(cells),
                           static_cast<float>(y) / static_cast<float>(cells)};
      uvs.push_back(uv);
      positions.push_back({2 * uv.x - 1, 2 * uv.y - 1, 0});
      if (x == cells || y == cells) continue;
      const auto a = static_cast<std::uint32_t>(y * (cells + 1) + x), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(cells) + 1, d = c + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  }
  return mesh_of(positions, triangles, true, uvs);
}

inline MeshDescription sphere_mesh(int level) {
  const Icosphere ball = make_icosphere(level);
  std::vector<Vec3f> positions;
  for (const Vec3d& d : ball.directions) positions.push_back(Vec3f(d));
  return mesh_of(positions, ball.triangles, true);
}

/// The closed room with its light out of view.
inline SceneDescription photon_room(int size) {
  SceneDescription scene = room(size, false);
  add_shape(scene, RectangleDescription{}, Transform::rotate({0, 1, 0}, 180) * Transform::translate({0, 0, -1}), {0});
  set_camera(scene, Transform::look_at({0, 0, 0.99}, {0, 0, 0}, {0, 1, 0}), 75, size);
  scene.integrator.method = PathDescription{-1, 5, true};
  return scene;
}

/// A slab 0.02 thick under the light of a closed room; only its dark side is visible. The room lights that side a tenth
/// as much as the other.
inline SceneDescription slab_from_below(int size) {
  SceneDescription scene = photon_room(size);
  add_shape(scene, box_mesh(), Transform::translate({0, 0.3, 0}) * Transform::scale({0.7, 0.01, 0.7}),
            add_bsdf(scene, DiffuseDescription{RgbD(0.6)}));
  set_camera(scene, Transform::look_at({0, -0.9, 0}, {0, 0.3, 0}, {0, 0, 1}), 60, size);
  return scene;
}

inline SceneDescription twosided_slab_from_below(int size) {
  SceneDescription scene = slab_from_below(size);
  const BsdfIndex grey = scene.shapes.back().bsdf;
  scene.shapes.back().bsdf = add_bsdf(scene, TwoSidedDescription{grey, grey});
  // A surface without thickness that shows both of its sides.
  add_shape(scene, square_mesh(1),
            Transform::translate({0, -0.3, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.25)),
            scene.shapes.back().bsdf);
  add_shape(scene, RectangleDescription{},
            Transform::translate({0.5, -0.3, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.2)),
            scene.shapes.back().bsdf);
  return scene;
}

inline SceneDescription mesh_sphere(int size) {
  SceneDescription scene = photon_room(size);
  add_shape(scene, sphere_mesh(4), Transform::translate({0, -0.4, -0.2}) * Transform::scale(Vec3d(0.5)),
            add_bsdf(scene, DiffuseDescription{RgbD(0.7)}));
  return scene;
}

/// The room's walls as one mesh, seen from inside, and a rotated box on its floor.
inline SceneDescription mesh_boxes(int size) {
  SceneDescription scene = photon_room(size);
  const ShapeDescription light = scene.shapes[5];
  scene.shapes = {light};
  add_shape(scene, box_mesh(), {}, {0}).flip_normals = true;
  add_shape(
      scene, box_mesh(),
      Transform::translate({-0.3, -0.6, -0.3}) * Transform::rotate({0, 1, 0}, 25) * Transform::scale({0.3, 0.4, 0.3}),
      add_bsdf(scene, DiffuseDescription{RgbD{0.3, 0.6, 0.5}}));
  return scene;
}

/// The room with a mesh for its floor.
inline SceneDescription with_mesh_floor(SceneDescription scene, BsdfIndex bsdf, int cells) {
  scene.shapes[1].geometry = square_mesh(cells);
  scene.shapes[1].bsdf = bsdf;
  return scene;
}

inline TextureIndex add_texture(SceneDescription& scene, int width, int height, bool raw,
                                const std::function<Rgb(int x, int y)>& colour) {
  auto image = std::make_shared<Image>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb c = colour(x, y);
      float* at = image->pixel(x, y);
      at[0] = c.x, at[1] = c.y, at[2] = c.z;
    }
  BitmapDescription bitmap;
  bitmap.filename = "made.exr";
  bitmap.image = image;
  bitmap.raw = raw;
  scene.textures.push_back({{}, "", bitmap});
  return {static_cast<std::uint32_t>(scene.textures.size() - 1)};
}

inline SceneDescription textured_mesh(int size) {
  SceneDescription scene = photon_room(size);
  const TextureIndex stripes = add_texture(scene, 8, 8, true, [](int x, int y) {
    return (x + y) % 2 == 0 ? Rgb{0.8f, 0.7f, 0.2f} : Rgb{0.1f, 0.2f, 0.5f};
  });
  const BsdfIndex floor = add_bsdf(scene, DiffuseDescription{stripes});
  return with_mesh_floor(scene, floor, 3);
}

/// Waves of the floor, as bumps of a flat mesh: normals tilt by up to 17 degrees.
inline SceneDescription bumped_mesh(int size) {
  SceneDescription scene = photon_room(size);
  const TextureIndex waves = add_texture(scene, 64, 8, true, [](int x, int) {
    return Rgb(static_cast<float>(0.5 + 0.5 * std::sin(2 * 3.14159265 * (x + 0.5) / 16)));
  });
  const BsdfIndex grey = add_bsdf(scene, DiffuseDescription{RgbD(0.7)});
  const BsdfIndex floor = add_bsdf(scene, BumpMapDescription{waves, 0.05, grey});
  return with_mesh_floor(scene, floor, 2);
}

/// Every normal of the floor tilts 20 degrees to one side.
inline SceneDescription normal_mapped_mesh(int size) {
  SceneDescription scene = photon_room(size);
  const double lean = 20 * 3.14159265358979 / 180;
  const TextureIndex leaning = add_texture(scene, 2, 2, true, [&](int, int) {
    return Rgb{static_cast<float>(0.5 + 0.5 * std::sin(lean)), 0.5f, static_cast<float>(0.5 + 0.5 * std::cos(lean))};
  });
  const BsdfIndex grey = add_bsdf(scene, DiffuseDescription{RgbD(0.7)});
  const BsdfIndex floor = add_bsdf(scene, NormalMapDescription{leaning, grey});
  return with_mesh_floor(scene, floor, 2);
}

inline SceneDescription heightfield(int size) {
  SceneDescription scene = photon_room(size);
  HeightfieldDescription field;
  field.columns = field.rows = 24;
  field.amplitude = 0.15;
  field.height = HeightfieldNoise{3, 3, 2};
  field.face_normals = true;
  scene.shapes[1].geometry = field;
  scene.shapes[1].to_world = Transform::translate({0, 0.25, 0}) * scene.shapes[1].to_world;
  return scene;
}

/// Two instances of a box and a ball, one rotated and scaled, one sheared.
inline SceneDescription sheared_instances(int size) {
  SceneDescription scene = photon_room(size);
  ShapeGroupDescription group;
  ShapeDescription box;
  box.geometry = box_mesh();
  box.to_world = Transform::scale({0.25, 0.02, 0.25});
  box.bsdf = add_bsdf(scene, DiffuseDescription{RgbD(0.6)});
  ShapeDescription ball = box;
  ball.geometry = sphere_mesh(3);
  ball.to_world = Transform::translate({0, 0.2, 0}) * Transform::scale(Vec3d(0.15));
  group.shapes = {box, ball};
  scene.groups.push_back(group);
  const auto place = [&](const Transform& to_world) {
    ShapeDescription shape;
    shape.geometry = InstanceDescription{{0}};
    shape.to_world = to_world;
    scene.shapes.push_back(shape);
  };
  place(Transform::translate({-0.45, -0.4, -0.2}) * Transform::rotate({0, 0, 1}, -20) * Transform::scale(Vec3d(1.4)));
  place(Transform::translate({0.45, -0.3, -0.2}) * Transform::rotate({1, 0, 0}, 35) * Transform::scale({1, 1.6, 1}) *
        Transform::rotate({0, 0, 1}, 30));
  return scene;
}

inline SceneDescription cylinder_and_disk(int size) {
  SceneDescription scene = photon_room(size);
  CylinderDescription pillar;
  pillar.p0 = {-0.4, -0.9, -0.3};
  pillar.p1 = {-0.4, 0.2, -0.3};
  pillar.radius = 0.2;
  const BsdfIndex grey = add_bsdf(scene, DiffuseDescription{RgbD(0.7)});
  add_shape(scene, pillar, {}, grey);
  add_shape(
      scene, DiskDescription{},
      Transform::translate({0.4, -0.4, -0.2}) * Transform::rotate({1, 0, 0}, -60) * Transform::scale({0.45, 0.25, 1}),
      grey);
  return scene;
}

}  // namespace photonproof::test
