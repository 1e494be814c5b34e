// Small scenes that sweeps start from: a floor of albedo 0.5 in y = 0 with one thing on it, and a square light above.
// The camera sees only the floor.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_stress {

using Geometry = decltype(ShapeDescription::geometry);
using BsdfModel = decltype(BsdfDescription::model);
using Light = decltype(EmitterDescription::light);

BsdfIndex add_bsdf(SceneDescription& scene, const BsdfModel& model);
ShapeDescription& add_shape(SceneDescription& scene, const Geometry& geometry, const Transform& to_world,
                            BsdfIndex bsdf);

/// A copy with `alpha` set in both directions; other parameters unchanged.
template <class Rough>
Rough of_roughness(double alpha) {
  Rough rough;
  if constexpr (requires { rough.alpha; })
    rough.alpha = alpha;
  else
    rough.alpha_u = rough.alpha_v = alpha;
  return rough;
}

/// A transform of unit shapes in the xy plane: turns them to face up, scales and places them.
Transform lying(const Vec3d& at, double size);
/// The same, facing down.
Transform hanging(const Vec3d& at, double size);
Transform standing(const Vec3d& at, double size);

/// Only the camera: from (0, 7, 5) towards the origin, 32 degrees wide.
SceneDescription empty_stress_scene();
/// Adds the floor, [-8,8]^2.
SceneDescription stress_scene_floor();
/// Adds the light, too: half edge 1, radiance 6, at (1, 5, -1).
SceneDescription lit_stress_scene();
/// Adds `model` on a ball of radius 1 that touches the floor; a checkerboard under it.
SceneDescription stress_scene_with_bsdf(const BsdfModel& model);
/// Floor and ball of radius 0.7, lit by `light` alone.
SceneDescription stress_scene_under(const Light& light);
/// Lit only by a shape that emits.
SceneDescription stress_scene_under_shape(const Geometry& geometry, const Transform& to_world, double radiance);

/// A closed sphere of radius 1 that emits e and reflects rho: e / (1 - rho) everywhere.
SceneDescription closed_sphere(double emission, double albedo);
/// A ball of radius 1 of this BSDF before a sky of radiance 1: without losses the radiance is 1 everywhere.
SceneDescription ball_in_uniform_sky(const BsdfModel& model);

/// Writes a mesh to a file in `folder` and returns a description that names it.
MeshDescription mesh_file(const std::filesystem::path& folder, const std::string& name, TriangleMesh mesh);
/// A mesh of these corners and triangles.
TriangleMesh mesh_of(const std::vector<Vec3f>& positions, const std::vector<TriangleMesh::Triangle>& triangles);

/// A feature's name and its scene.
using NamedScene = std::pair<std::string, SceneDescription>;
/// A scene for every shape, BSDF, light, camera, texture, medium and way to gather photons.
std::vector<NamedScene> scenes_of_features(const std::filesystem::path& assets);

}  // namespace photonproof::inline harness_stress
