#include "renderer/scene.h"

#include <algorithm>
#include <cmath>

namespace photonproof {
namespace {

Bsdf compile(const DiffuseDescription& d) { return DiffuseBsdf{Rgb(d.reflectance)}; }
Bsdf compile(const ConductorDescription& d) {
  ConductorBsdf bsdf{Rgb(d.specular_reflectance)};
  if (d.ior) {
    bsdf.has_ior = true;
    bsdf.eta = Rgb(d.ior->eta);
    bsdf.k = Rgb(d.ior->k);
  }
  return bsdf;
}
Bsdf compile(const DielectricDescription& d) {
  return DielectricBsdf{static_cast<float>(d.int_ior / d.ext_ior), Rgb(d.specular_reflectance),
                        Rgb(d.specular_transmittance)};
}

Light compile(const PointLightDescription& d) { return PointLight{Vec3f(d.position), Rgb(d.intensity)}; }

Light surface_light(const Quad& quad, const Rgb& radiance) { return QuadLight{quad, radiance}; }
Light surface_light(const Sphere& sphere, const Rgb& radiance) { return SphereLight{sphere, radiance}; }

/// Local-to-face transforms of the cube's six sides: each maps [-1,1]^2 (normal +z) onto one side, normal outward.
std::array<Transform, 6> cube_faces() {
  const Vec3d x{1, 0, 0}, y{0, 1, 0};
  const Transform top = Transform::translate({0, 0, 1});
  return {top,
          Transform::rotate(y, 180) * top,
          Transform::rotate(y, 90) * top,
          Transform::rotate(y, -90) * top,
          Transform::rotate(x, 90) * top,
          Transform::rotate(x, -90) * top};
}

/// Estimators divide by areas and normalise by them: both must stay finite with room to spare.
bool has_usable_size(const std::variant<Quad, Sphere>& geometry) {
  const auto* quad = std::get_if<Quad>(&geometry);
  const float area = quad != nullptr ? quad->area : std::get<Sphere>(geometry).area();
  return area > 1e-30f && area < 1e30f;
}

double mean_channel(const Rgb& rgb) { return (double{rgb.x} + rgb.y + rgb.z) / 3; }

}  // namespace

Scene::Scene(const SceneDescription& description, int width_, int height_)
    : width(width_), height(height_), camera(description.sensor, width_, height_) {
  for (const BsdfDescription& b : description.bsdfs)
    bsdfs.push_back(std::visit([](const auto& model) { return compile(model); }, b.model));
  for (const ShapeDescription& shape : description.shapes) add_shape(description, shape);
  for (const EmitterDescription& e : description.emitters)
    lights.push_back(std::visit([](const auto& light) { return compile(light); }, e.light));

  double total = 0;
  for (const Light& light : lights) total += mean_channel(flux(light));
  double sum = 0;
  for (const Light& light : lights) {
    const double p = total > 0 ? mean_channel(flux(light)) / total : 1.0 / static_cast<double>(lights.size());
    sum += p;
    light_probability_.push_back(static_cast<float>(p));
    light_cdf_.push_back(static_cast<float>(sum));
  }
  tracer_ = std::make_unique<Tracer>(surfaces);
}

void Scene::add_shape(const SceneDescription& description, const ShapeDescription& shape) {
  const std::size_t first = surfaces.size();
  if (const auto* sphere = std::get_if<SphereDescription>(&shape.geometry)) {
    const double scale = std::cbrt(std::abs(shape.to_world.determinant()));
    add_surface(Sphere{Vec3f(shape.to_world.point(sphere->center)), static_cast<float>(sphere->radius * scale),
                       shape.flip_normals},
                shape);
  } else if (std::holds_alternative<RectangleDescription>(shape.geometry)) {
    add_quad(shape, shape.to_world);
  } else if (std::holds_alternative<PlyDescription>(shape.geometry)) {
    throw InputError(description.where(shape.loc), "the renderer has no triangle meshes");
  } else {
    for (const Transform& face : cube_faces()) add_quad(shape, shape.to_world * face);
  }
  for (auto surface = surfaces.begin() + static_cast<std::ptrdiff_t>(first); surface != surfaces.end(); ++surface)
    if (!has_usable_size(surface->geometry))
      throw InputError(description.where(shape.loc), "the shape's area is outside what single precision can hold");
  const std::size_t emitters = lights.size();
  if (shape.radiance && emitters > 0 && !std::isfinite(mean_channel(flux(lights.back()))))
    throw InputError(description.where(shape.loc), "the light's flux is too large for single precision");
}

void Scene::add_surface(const std::variant<Quad, Sphere>& geometry, const ShapeDescription& shape) {
  Surface surface{geometry, shape.bsdf.value, no_index};
  if (shape.radiance) {
    surface.light = static_cast<std::uint32_t>(lights.size());
    lights.push_back(std::visit([&](const auto& g) { return surface_light(g, Rgb(*shape.radiance)); }, geometry));
  }
  surfaces.push_back(surface);
}

void Scene::add_quad(const ShapeDescription& shape, const Transform& face_to_world) {
  const Vec3d corner = face_to_world.point({-1, -1, 0});
  const Vec3d edge_u = face_to_world.vector({2, 0, 0});
  const Vec3d edge_v = face_to_world.vector({0, 2, 0});
  const Vec3d n = cross(edge_u, edge_v);
  const double area = length(n);
  // A mirrored transform turns the winding round but not the side Mitsuba's normal (inverse transpose) points to.
  const bool mirrored = shape.to_world.determinant() < 0;
  const Vec3d normal = n / area * (shape.flip_normals != mirrored ? -1.0 : 1.0);
  add_surface(Quad{Vec3f(corner), Vec3f(edge_u), Vec3f(edge_v), Vec3f(normal), static_cast<float>(area)}, shape);
}

Scene::LightChoice Scene::choose_light(float u) const {
  const auto it = std::upper_bound(light_cdf_.begin(), light_cdf_.end(), u);
  std::uint32_t index = static_cast<std::uint32_t>(
      std::min<std::ptrdiff_t>(it - light_cdf_.begin(), static_cast<std::ptrdiff_t>(lights.size()) - 1));
  while (index > 0 && light_probability_[index] == 0) --index;  // u above the rounded sum, last lights dark
  return {index, light_probability_[index]};
}

}  // namespace photonproof
