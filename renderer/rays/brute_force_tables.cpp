#include "renderer/rays/brute_force_tables.h"

namespace photonproof::inline renderer_rays {
namespace {

/// In double precision, since the result is used for every ray.
Plate plate(const Vec3d& corner, const Vec3d& edge_u, const Vec3d& edge_v, const Vec3d& normal) {
  const Vec3d n = cross(edge_u, edge_v);
  const Vec3d along_u = cross(edge_v, n);
  const Vec3d along_v = cross(n, edge_u);
  const Vec3d u = along_u / dot(edge_u, along_u);
  const Vec3d v = along_v / dot(edge_v, along_v);
  return {Vec3f(normal), static_cast<float>(dot(normal, corner)), Vec3f(u), static_cast<float>(-dot(u, corner)),
          Vec3f(v),      static_cast<float>(-dot(v, corner))};
}

Plate plate(const LongFace& face) { return plate(face.corner, face.edge_u, face.edge_v, face.normal); }

}  // namespace

bool BruteForceTables::can_hold(const Geometry& geometry, double largest_ball) {
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) return sphere->radius <= largest_ball;
  if (const auto* mesh = std::get_if<Mesh>(&geometry)) return mesh->shells_of == nullptr;
  return std::holds_alternative<Quad>(geometry);
}

BruteForceTables::BruteForceTables(const std::vector<Surface>& surfaces) : first_primitive_(surfaces.size(), 0) {
  const auto add = [&](std::uint32_t surface, std::size_t triangle = 0) {
    surface_of_primitive_.push_back(surface);
    triangle_of_primitive_.push_back(static_cast<std::uint32_t>(triangle));
  };
  const auto start = [&](std::uint32_t surface) {
    first_primitive_[surface] = static_cast<std::uint32_t>(surface_of_primitive_.size());
  };
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const auto* quad = std::get_if<Quad>(&surfaces[i].geometry);
    if (quad == nullptr) continue;
    start(i);
    add(i);
    const LongFace* face = surfaces[i].long_face(0);
    plates_.push_back(face != nullptr
                          ? plate(*face)
                          : plate(Vec3d(quad->corner), Vec3d(quad->edge_u), Vec3d(quad->edge_v), Vec3d(quad->normal)));
  }
  parallelograms_ = static_cast<std::uint32_t>(plates_.size());
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const auto* mesh = std::get_if<Mesh>(&surfaces[i].geometry);
    if (mesh == nullptr) continue;
    start(i);
    for (std::size_t t = 0; t < mesh->triangle_count(); ++t) {
      const Vec3d corner(mesh->corner(t, 0));
      const Vec3d edge_u = Vec3d(mesh->corner(t, 1)) - corner;
      const Vec3d edge_v = Vec3d(mesh->corner(t, 2)) - corner;
      const Vec3d n = cross(edge_u, edge_v) * (mesh->inward ? -1.0 : 1.0);
      add(i, t);
      if (dot(n, n) == 0) {  // has a place, since lights count their triangles, but a plate that no ray meets
        plates_.emplace_back();
        continue;
      }
      const LongFace* face = surfaces[i].long_face(t);
      plates_.push_back(face != nullptr ? plate(*face) : plate(corner, edge_u, edge_v, normalize(n)));
    }
  }
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const auto* sphere = std::get_if<Sphere>(&surfaces[i].geometry);
    if (sphere == nullptr) continue;
    start(i);
    add(i);
    balls_.push_back({Vec3f(sphere->center), static_cast<float>(sphere->radius), sphere->inward ? -1.0f : 1.0f});
  }
  if (surface_of_primitive_.empty()) add(0);  // what rays that miss gather
}

BruteForceView BruteForceTables::view() const {
  return {plates_.data(),
          balls_.data(),
          surface_of_primitive_.data(),
          parallelograms_,
          static_cast<std::uint32_t>(plates_.size()) - parallelograms_,
          static_cast<std::uint32_t>(balls_.size())};
}

}  // namespace photonproof::inline renderer_rays
