#include "harness/variants/plain_objects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline harness_variants {
namespace {

[[noreturn]] void cannot_say(const SceneDescription& scene, const SourceLoc& loc, const std::string& what) {
  throw InputError(scene.where(loc), "the course's scene files cannot express " + what);
}

RgbD plain_colour(const SceneDescription& scene, const Colour& colour, const SourceLoc& loc, const char* of) {
  const auto* rgb = std::get_if<RgbD>(&colour);
  if (!rgb) cannot_say(scene, loc, std::string("a texture as ") + of);
  return *rgb;
}

/// Rounds away the error of rotations: 29 instead of 29.000000000000004.
double rounded(double v, double scale) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.12g", v);
  const double near = std::strtod(text, nullptr);
  if (std::abs(near) <= 1e-13 * scale) return 0;
  return std::abs(near - v) <= 1e-13 * scale ? near : v;
}

Vec3d rounded(const Vec3d& v) {
  const double scale = std::max({1.0, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return {rounded(v.x, scale), rounded(v.y, scale), rounded(v.z, scale)};
}

void set_material(const SceneDescription& scene, BsdfIndex index, PlainObject& object) {
  const BsdfDescription& bsdf = scene.bsdfs.at(index.value);
  const auto plain = [&](const Colour& colour) { return plain_colour(scene, colour, bsdf.loc, "a material's colour"); };
  std::visit(Overloaded{[&](const DiffuseDescription& d) {
                          object.material = PlainMaterial::diffuse;
                          object.colour = plain(d.reflectance);
                        },
                        [&](const ConductorDescription& d) {
                          if (d.ior) cannot_say(scene, bsdf.loc, "a metal's index of refraction");
                          object.material = PlainMaterial::mirror;
                          object.colour = plain(d.specular_reflectance);
                        },
                        [&](const DielectricDescription& d) {
                          if (plain(d.specular_reflectance) != RgbD(1.0) || d.priority)
                            cannot_say(scene, bsdf.loc, "a glass with specular_reflectance or priority");
                          object.material = PlainMaterial::glass;
                          object.colour = plain(d.specular_transmittance);
                          object.ior = d.int_ior / d.ext_ior;
                        },
                        [&](const TwoSidedDescription& d) {
                          if (d.front != d.back) cannot_say(scene, bsdf.loc, "a material with two different sides");
                          set_material(scene, d.front, object);
                        },
                        [&](const auto&) {
                          cannot_say(scene, bsdf.loc,
                                     "this material" + (bsdf.id.empty() ? "" : " " + in_quotes(bsdf.id)) +
                                         ", only diffuse, conductor without metal, dielectric");
                        }},
             bsdf.model);
  if (object.name.empty()) object.name = bsdf.id;
}

void set_water(const SceneDescription& scene, const ShapeDescription& shape, const HeightfieldDescription& field,
               PlainObject& object) {
  const auto* noise = std::get_if<HeightfieldNoise>(&field.height);
  if (!noise || noise->octaves != 1 || field.face_normals)
    cannot_say(scene, shape.loc, "a heightfield but of one octave of noise with normals of vertices");
  object.a = shape.to_world.vector({1, 0, 0});
  object.b = shape.to_world.vector({0, 1, 0});
  const Vec3d up = shape.to_world.vector({0, 0, 1});
  object.c = up * field.amplitude;
  if (shape.flip_normals) cannot_say(scene, shape.loc, "water whose front is below");
  object.columns = field.columns;
  object.rows = field.rows;
  object.frequency_x = noise->frequency_x;
  object.frequency_y = noise->frequency_y;
  object.noise_seed = noise->seed;
}

void set_shape(const SceneDescription& scene, const ShapeDescription& shape, PlainObject& object) {
  const Transform& t = shape.to_world;
  object.middle = t.point({0, 0, 0});
  std::visit(Overloaded{[&](const SphereDescription& sphere) {
                          object.kind = PlainKind::sphere;
                          object.middle = t.point(sphere.center);
                          object.radius = rounded(sphere.radius * length(t.vector({1, 0, 0})), sphere.radius);
                        },
                        [&](const RectangleDescription&) {
                          object.kind = PlainKind::rectangle;
                          object.a = t.vector({1, 0, 0});
                          object.b = t.vector({0, 1, 0});
                          // A mirroring transform keeps the normal on local +z's side, which reverses the cross
                          // product.
                          const bool turned = dot(cross(object.a, object.b), t.vector({0, 0, 1})) < 0;
                          if (turned != shape.flip_normals) std::swap(object.a, object.b);
                        },
                        [&](const CubeDescription&) {
                          object.kind = PlainKind::box;
                          object.a = t.vector({1, 0, 0});
                          object.b = t.vector({0, 1, 0});
                          object.c = t.vector({0, 0, 1});
                        },
                        [&](const HeightfieldDescription& field) {
                          object.kind = PlainKind::water;
                          set_water(scene, shape, field, object);
                        },
                        [&](const auto&) {
                          cannot_say(scene, shape.loc, "this shape, only sphere, rectangle, cube, heightfield");
                        }},
             shape.geometry);
  if (shape.flip_normals && object.kind != PlainKind::rectangle && object.kind != PlainKind::water)
    cannot_say(scene, shape.loc, "flip_normals of a " + std::string(word_of(object.kind)));
  object.middle = rounded(object.middle);
  object.a = rounded(object.a);
  object.b = rounded(object.b);
  object.c = rounded(object.c);
}

}  // namespace

const char* word_of(PlainKind kind) {
  static constexpr const char* words[] = {"sphere", "rectangle", "box", "water"};
  return words[static_cast<int>(kind)];
}

const char* word_of(PlainMaterial material) {
  static constexpr const char* words[] = {"diffuse", "mirror", "glass", "light"};
  return words[static_cast<int>(material)];
}

std::vector<PlainObject> plain_objects(const SceneDescription& scene) {
  if (!scene.emitters.empty()) cannot_say(scene, scene.emitters.front().loc, "a light other than a shape that shines");
  std::vector<PlainObject> objects;
  for (const ShapeDescription& shape : scene.shapes) {
    if (shape.interior || shape.exterior) cannot_say(scene, shape.loc, "a medium");
    PlainObject object;
    object.name = shape.id;
    set_shape(scene, shape, object);
    set_material(scene, shape.bsdf, object);
    if (shape.emits_along_normal) cannot_say(scene, shape.loc, "a light that shines along its normal");
    if (shape.radiance) {
      object.material = PlainMaterial::light;
      object.radiance = plain_colour(scene, *shape.radiance, shape.loc, "a light's radiance");
    }
    objects.push_back(object);
  }
  return objects;
}

namespace {

/// The side of the image along which the angle of view is measured.
double side_along_fov(const PerspectiveDescription& camera, double w, double h) {
  if (camera.fov_axis == FovAxis::y) return h;
  if (camera.fov_axis == FovAxis::smaller) return std::min(w, h);
  if (camera.fov_axis == FovAxis::larger) return std::max(w, h);
  return camera.fov_axis == FovAxis::diagonal ? std::hypot(w, h) : w;
}

}  // namespace

double vertical_tangent(const PerspectiveDescription& camera, int width, int height) {
  return std::tan(camera.fov_degrees * M_PI / 360) * height / side_along_fov(camera, width, height);
}

PlainCamera plain_camera(const SceneDescription& scene, int width, int height) {
  const auto* camera = std::get_if<PerspectiveDescription>(&scene.sensor.camera);
  if (!camera) cannot_say(scene, scene.sensor.loc, "a camera but a perspective one");
  const double shift_x = camera->principal_x * width, shift_y = camera->principal_y * height;
  if (std::abs(shift_x - std::round(shift_x)) > 1e-6 || std::abs(shift_y - std::round(shift_y)) > 1e-6)
    cannot_say(scene, scene.sensor.loc, "a view shifted by parts of a pixel (principal_point_offset)");
  const Transform& t = scene.sensor.to_world;
  const bool is_vertical = side_along_fov(*camera, width, height) == height;
  const double degrees =
      is_vertical ? camera->fov_degrees : std::atan(vertical_tangent(*camera, width, height)) * 360 / M_PI;
  return {rounded(t.point({0, 0, 0})),
          rounded(normalize(t.vector({0, 0, 1}))),
          rounded(normalize(t.vector({0, 1, 0}))),
          degrees,
          camera->near_clip,
          static_cast<int>(std::lround(shift_x)),
          static_cast<int>(std::lround(shift_y))};
}

}  // namespace photonproof::inline harness_variants
