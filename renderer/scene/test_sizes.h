// A scene whose every length is given in a unit, so that tests can build it at any size, and comparisons of the
// results. It shares no code with scaled_description.cpp.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::test {

/// Positions times `size`, as if the file contained them.
inline std::shared_ptr<const TriangleMesh> pyramid(double size) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(5);
  const Vec3d corners[5] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < 5; ++i) mesh->positions[i] = Vec3f(corners[i] * size);
  mesh->triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return mesh;
}

/// (-1,-1), (3,-1), (-1,3) in the local xy plane, times `size`: holds the square [-1,1]^2.
inline std::shared_ptr<const TriangleMesh> large_triangle(double size) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(3);
  const Vec3d corners[3] = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
  for (std::size_t i = 0; i < 3; ++i) mesh->positions[i] = Vec3f(corners[i] * size);
  mesh->triangles = {{0, 1, 2}};
  return mesh;
}

struct Room {
  double unit = 1;
  bool media = false;   ///< for volpath
  bool bodies = false;  ///< mirrors and glass, textures' bumps, a lens
};

/// The placement of a shape of that size in the room.
inline Transform placed(const Room& room, double x, double y, double z, double size) {
  return Transform::translate(Vec3d{x, y, z} * room.unit) * Transform::scale(Vec3d(size * room.unit));
}

/// An endless floor, and a shape of every kind on it.
inline void add_shapes_to_see(const Room& room, SceneDescription& d) {
  const double u = room.unit;
  const auto at = [&](double x, double y, double z, double size) { return placed(room, x, y, z, size); };
  const BsdfIndex grey = add_bsdf(d, DiffuseDescription{RgbD(0.6)});
  BsdfIndex bumpy = grey, shiny = grey;
  if (room.bodies) {
    d.textures.push_back({{}, "", CheckerboardDescription{RgbD(0.9), RgbD(0.1), Transform::scale(Vec3d(8))}});
    bumpy = add_bsdf(d, BumpMapDescription{{0}, 0.3 * u, grey});
    shiny = add_bsdf(d, ConductorDescription{});
  }
  add_shape(d, PlaneDescription{}, at(0, 0, -0.1, 1), grey);
  add_shape(d, RectangleDescription{}, at(0, 0, 0, 4), bumpy);
  add_shape(d, SphereDescription{{0, 0, 0}, 0.5}, at(-1.5, 1.5, 0.5, 1), shiny);
  add_shape(d, CubeDescription{}, at(0, 1.5, 0.4, 0.4), grey);
  add_shape(d, DiskDescription{}, at(1.5, 1.5, 0.3, 0.6), grey);
  add_shape(d, CylinderDescription{{0, 0, 0}, {0, 0, 1}, 0.4}, at(-1.5, 0, 0, 1), grey);
  const auto ply = MeshDescription::Format::ply;
  add_shape(d, MeshDescription{ply, "pyramid.ply", true, false, pyramid(0.6 * u)},
            Transform::translate(Vec3d{0, 0, 0.01} * u), grey);
  add_shape(d, HeightfieldDescription{8, 8, 0.2, true, HeightfieldNoise{2, 2, 2, 7}}, at(1.5, 0, 0.25, 0.6), grey);
  const auto place = [&](const Vec3d& p, double radius) {
    return CurvePoint{Vec3f(p * u), static_cast<float>(radius * u)};
  };
  CurvesDescription tubes{CurvesDescription::Basis::linear, "tubes.txt", {}};
  tubes.curves = std::make_shared<const CurveSet>(CurveSet{
      {place({0, -1, 0.2}, 0.1), place({0.6, -1.4, 0.5}, 0.1), place({1, -1, 0.8}, 0.05), place({1.4, -1, 1}, 0)},
      {0}});
  add_shape(d, tubes, {}, grey);
  tubes.basis = CurvesDescription::Basis::bspline;
  add_shape(d, tubes, Transform::translate(Vec3d{0.3, 0.3, 0} * u), grey);
  auto distances = std::make_shared<VolumeGrid>();
  distances->width = distances->height = distances->depth = 2;
  distances->values = {-1, 1, -1, 0.5f, -0.5f, 1, 0.5f, 1};
  add_shape(d, SdfGridDescription{"slope.vol", distances, {}}, at(0.4, -2, 0.05, 0.5), grey);
  auto cloud = std::make_shared<EllipsoidCloud>();
  const auto of_unit = [&](const Vec3d& v) { return Vec3f(v * u); };
  cloud->ellipsoids = {{of_unit({-0.4, 1.3, 0.3}), of_unit({0.05, 0.1, 0.03}), {0.6f, 0, 0, 0.8f}},
                       {of_unit({-1, 1.5, 0.2}), of_unit({0.04, 0.04, 0.05})}};
  EllipsoidsDescription ellipsoids;
  ellipsoids.filename = "cloud.ply";
  ellipsoids.cloud = cloud;
  add_shape(d, ellipsoids, {}, grey);
  ShapeGroupDescription group;
  ShapeDescription member;
  member.geometry = MeshDescription{ply, "pyramid.ply", true, false, pyramid(1)};
  member.bsdf = grey;
  group.shapes.push_back(member);
  d.groups.push_back(group);
  add_shape(d, InstanceDescription{{0}}, at(-1.5, -1.5, 0.01, 0.6), grey);
}

/// A light of every kind of finite extent, and dim environment light. Intensities scale with the square of the unit.
inline void add_lights(const Room& room, SceneDescription& d) {
  const double u = room.unit;
  const auto at = [&](double x, double y, double z, double size) { return placed(room, x, y, z, size); };
  const BsdfIndex black = add_bsdf(d, DiffuseDescription{RgbD(0)});
  const auto light = [&](const decltype(ShapeDescription::geometry)& geometry, const Transform& to_world) {
    add_shape(d, geometry, to_world * Transform::rotate({1, 0, 0}, 180), black).radiance = RgbD(3);
  };
  light(RectangleDescription{}, at(-1, -1, 3, 0.3));
  light(SphereDescription{{0, 0, 0}, 1}, at(1, -1, 3, 0.2));
  light(DiskDescription{}, at(1, 1, 3, 0.3));
  light(CylinderDescription{{0, 0, 0}, {0, 0, 1}, 0.3}, at(-1, 1, 3, 0.5));
  light(MeshDescription{MeshDescription::Format::ply, "pyramid.ply", true, false, pyramid(0.3 * u)},
        Transform::translate(Vec3d{0, 0, 3} * u));
  const RgbD intensity = RgbD(0.5) * (u * u);
  d.emitters.push_back({{}, "", PointLightDescription{Vec3d{2, -2, 2} * u, intensity}});
  SpotLightDescription spot;
  spot.to_world = Transform::look_at(Vec3d{-2, -2, 3} * u, {0, 0, 0}, {0, 1, 0});
  spot.intensity = intensity * 4.0;
  d.emitters.push_back({{}, "", spot});
  auto profile = std::make_shared<IesProfile>();
  profile->vertical_degrees = {0, 60, 90};
  profile->horizontal_degrees = {0};
  profile->candela = {2, 1, 0};
  d.emitters.push_back({{}, "", IesLightDescription{"lamp.ies", profile, intensity, at(2, 2, 3, 1 / u)}});
  ProjectorDescription projector;
  projector.scale = 0.4 * u * u;
  projector.to_world = Transform::look_at(Vec3d{-3, 0, 2} * u, {0, 0, 0}, {0, 0, 1});
  d.emitters.push_back({{}, "", projector});
  d.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.02)}});
}

/// The shapes with the lights over them, and the camera.
inline SceneDescription room_of_all_shapes(const Room& room) {
  const double u = room.unit;
  SceneDescription d;
  add_shapes_to_see(room, d);
  add_lights(room, d);
  if (room.media) {
    d.media.push_back({{}, "", HomogeneousDescription{RgbD{0.1, 0.2, 0.3} * (1 / u), RgbD(0.8), 1, {}}});
    d.sensor.medium = MediumIndex{0};
    add_shape(d, SphereDescription{{0, 0, 0}, 20}, placed(room, 0, 0, 0, 1), add_bsdf(d, NullDescription{}));
    d.shapes.back().interior = MediumIndex{0};
  }
  PerspectiveDescription camera{.fov_degrees = 50, .near_clip = 0.01 * u, .far_clip = 100 * u};
  d.sensor.camera = camera;
  if (room.bodies) d.sensor.camera = ThinLensDescription{camera, 0.1 * u, 5 * u};
  d.sensor.to_world = Transform::look_at(Vec3d{1, -5, 4} * u, Vec3d{0, 0, 0.4} * u, {0, 0, 1});
  d.sensor.film.width = 24;
  d.sensor.film.height = 16;
  PhotonMapperDescription photons;
  photons.global_radius = 0.2 * u;
  photons.caustic_radius = 0.1 * u;
  photons.max_depth = 6;
  d.integrator.method = photons;
  return d;
}

/// Compares images from the same random numbers. They are equal within rounding except at a few values, where a path
/// went round the other side of an edge, and in the mean.
inline void expect_same_picture(const Image& image, const Image& expected, const std::string& what) {
  ASSERT_EQ(image.rgb.size(), expected.rgb.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (!(std::abs(image.rgb[i] - expected.rgb[i]) <= 2e-3f * (image.rgb[i] + expected.rgb[i]) + 1e-6f)) ++different;
  EXPECT_LE(different, image.rgb.size() / 25) << what;
  EXPECT_NEAR(image_mean(image), image_mean(expected), 0.004 * image_mean(expected)) << what;
}

}  // namespace photonproof::test
