#include "renderer/lights/compile_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/base/faults.h"
#include "scenes/description/field_of_view.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_lights {
namespace {

Vec3f axis(const Transform& to_world, const Vec3d& local) { return Vec3f(normalize(to_world.vector(local))); }

/// The first two axes of a right-handed frame whose third is `forward`; the first is near `right`.
std::pair<Vec3f, Vec3f> across(const Vec3f& forward, const Vec3f& right) {
  const Vec3f x = normalize(right - forward * dot(right, forward));
  return {x, cross(forward, x)};
}

// --- shapes ----------------------------------------------------------------------------------------------------------

/// The offset of a light whose centre may be far from the visible scene, which is near the origin.
float offset_if_far(const Vec3d& center, double offset) {
  constexpr double far_away = 4096;  // times the surface's distance
  return length(center) > far_away * std::abs(offset) ? static_cast<float>(offset) : told_by_corner;
}
DiskShape disk_shape(const Disk& d) {
  return {d.center, d.axis_x, d.axis_y, d.normal,
          offset_if_far(Vec3d(d.center), dot(Vec3d(d.normal), Vec3d(d.center)))};
}
float offset_of(const Sphere& s) {
  const double distance = length(s.center);
  return offset_if_far(s.center, (distance - s.radius) * ((distance + s.radius) / (2 * s.radius)));
}

QuadShape quad_shape(const Quad& q, const LongFace* face) {
  return {q.corner, q.edge_u, q.edge_v, q.normal, face != nullptr ? static_cast<float>(face->offset) : told_by_corner};
}

/// Makes the light's shape from the rendered surface, and from the description where the surface lacks data.
struct LightShaper {
  const Surface& surface;
  const ShapeDescription& shape;
  const Transform& to_world;
  const std::string& where;

  LightShape operator()(const Quad& q) const { return quad_shape(q, surface.long_face(0)); }
  LightShape operator()(const Disk& d) const { return disk_shape(d); }
  LightShape operator()(const Sphere& s) const {
    return SphereShape{Vec3f(s.center),
                       static_cast<float>(s.radius),
                       axis(to_world, {1, 0, 0}),
                       axis(to_world, {0, 1, 0}),
                       axis(to_world, {0, 0, 1}),
                       s.inward ? -1.0f : 1.0f,
                       offset_of(s)};
  }
  LightShape operator()(const Mesh& mesh) const {
    std::vector<Vec3f> positions(mesh.positions.begin(), mesh.positions.end() - 1);  // the last is padding
    std::vector<Vec2<float>> uvs = mesh.source->uvs;
    if (mesh.flip_v)
      for (Vec2<float>& uv : uvs) uv.y = 1 - uv.y;
    return MeshShape(std::move(positions), mesh.source->triangles, std::move(uvs), mesh.inward, surface.long_faces);
  }
  LightShape operator()(const Plane&) const { refuse(); }
  LightShape operator()(const MeshInstance&) const { refuse(); }
  LightShape operator()(const Curves&) const { refuse(); }
  LightShape operator()(const SdfGrid&) const { refuse(); }
  LightShape operator()(const Ellipsoids&) const { refuse(); }
  LightShape operator()(const auto& other) const { return light_shape(other, shape, to_world); }

 private:
  [[noreturn]] void refuse() const { throw InputError(where, "this shape cannot be a light"); }
};

Light smooth_mesh_light(const Surface& surface, const Rgb& radiance) {
  const Mesh& mesh = std::get<Mesh>(surface.geometry);
  std::vector<Vec3f> positions(mesh.positions.begin(), mesh.positions.end() - 1);  // the last is padding
  return SmoothMeshLight(MeshShape(std::move(positions), mesh.source->triangles, {}, mesh.inward, surface.long_faces),
                         mesh.source->triangles, mesh.normals, mesh.inward, radiance);
}

/// Quads, spheres and disks with a radiance of one colour are sampled in lanes.
Light plain_light(const LightShaper& shaper, const Rgb& radiance) {
  return std::visit(Overloaded{[&](const Quad& q) -> Light {
                                 const QuadShape shape = quad_shape(q, shaper.surface.long_face(0));
                                 return QuadLight<float>{q.corner, q.edge_u, q.edge_v,    q.normal,
                                                         q.area,   radiance, shape.offset};
                               },
                               [&](const Sphere& s) -> Light {
                                 return SphereLight<float>{Vec3f(s.center), static_cast<float>(s.radius),
                                                           s.inward ? -1.0f : 1.0f, radiance, offset_of(s)};
                               },
                               [&](const Disk& d) -> Light {
                                 const DiskShape shape = disk_shape(d);
                                 return DiskLight<float>{d.center,     d.axis_x, d.axis_y,    d.normal,
                                                         shape.area(), radiance, shape.offset};
                               },
                               [&](const auto& other) -> Light { return AreaLight(shaper(other), radiance); }},
                    shaper.surface.geometry);
}

// --- emitters --------------------------------------------------------------------------------------------------------

struct Compiler {
  const Vec3d& moved;
  const SceneBall& ball;
  const TextureLookup& texture;
  const std::string& where;

  Light operator()(const PointLightDescription& d) const {
    return PointLight<float>{Vec3f(d.position + moved), Rgb(d.intensity)};
  }

  Light operator()(const SpotLightDescription& d) const {
    const double radians = std::numbers::pi / (has_fault(Fault::spot_angle) ? 360 : 180);
    const SpotLight<float> spot = spot_light(Vec3f(d.to_world.point({0, 0, 0}) + moved), axis(d.to_world, {0, 0, 1}),
                                             Rgb(d.intensity), d.beam_degrees * radians, d.cutoff_degrees * radians);
    if (!d.texture) return spot;
    if (d.cutoff_degrees >= 90) throw InputError(where, "a spot light with a texture needs a cutoff_angle below 90");
    const auto [right, up] = across(spot.axis, Vec3f(d.to_world.vector({1, 0, 0})));
    return TexturedSpotLight(spot, right, up, texture(*d.texture, where));
  }

  Light operator()(const ProjectorDescription& d) const {
    constexpr int cells = 64, most_steps = 64;
    const auto* image = std::get_if<TextureIndex>(&d.irradiance);
    const Vec2<int> size = image != nullptr ? texture.resolution(*image) : Vec2<int>{1, 1};
    const Vec2<double> half = half_tangents(d.fov_degrees, d.fov_axis, size.x, size.y);
    const Vec3f forward = axis(d.to_world, {0, 0, 1});
    const auto [right, down] = across(forward, -axis(d.to_world, {1, 0, 0}));
    const ProjectorScreen screen{Vec3f(d.to_world.point({0, 0, 0}) + moved),
                                 right,
                                 down,
                                 forward,
                                 static_cast<float>(half.x),
                                 static_cast<float>(half.y)};
    const double factor = std::numbers::pi * d.scale * d.to_world.similarity_scale();
    if (image == nullptr) {
      const Rgb constant_image(constant(d.irradiance) * factor);
      return ProjectorLight(
          screen, [=](const Vec2<float>&) { return constant_image; }, 1, 1);
    }
    // Every texel is the nearest one of a point.
    const int steps = std::clamp((std::max(size.x, size.y) + cells - 1) / cells, 4, most_steps);
    const LightTexture shown = texture(*image, where);
    return ProjectorLight(
        screen, [=](const Vec2<float>& uv) { return shown(uv) * static_cast<float>(factor); }, cells, steps);
  }

  Light operator()(const DirectionalLightDescription& d) const {
    return DirectionalLight<float>{Vec3f(normalize(d.direction)), Rgb(d.irradiance), ball.center, ball.radius};
  }

  Light operator()(const ConstantLightDescription& d) const { return sky(ConstantSky{Rgb(d.radiance)}); }

  Light operator()(const EnvmapDescription& d) const {
    const Image& image = *d.image;
    if (image.width < 2 || image.height < 3) throw InputError(where, "an envmap needs at least 2x3 pixels");
    if (!std::all_of(image.rgb.begin(), image.rgb.end(), [](float v) { return std::isfinite(v) && v >= 0; }))
      throw InputError(where, "the envmap's pixels must be finite and not negative");
    return sky(EnvmapSky(image, static_cast<float>(d.scale),
                         has_fault(Fault::turned_sky) ? *d.to_world.inverse() : d.to_world));
  }

  Light operator()(const SunSkyDescription& d) const {
    return sky(SunSky({d.sun_direction, d.turbidity, d.albedo, d.sun_scale, d.sky_scale,
                       double{usable_sun_aperture(static_cast<float>(d.sun_aperture_degrees))} * std::numbers::pi / 180,
                       d.to_world}));
  }

  Light operator()(const IesLightDescription& d) const {
    const Vec3f zenith = axis(d.to_world, {0, 0, 1});
    const auto [c0, c90] = across(zenith, Vec3f(d.to_world.vector({1, 0, 0})));
    return IesLight(Vec3f(d.to_world.point({0, 0, 0}) + moved), c0, c90, zenith, Rgb(d.intensity), *d.profile);
  }

 private:
  Light sky(Sky s) const { return EnvironmentLight(std::move(s), ball.center, ball.radius); }
};

/// Checks the flux, as choosing lights divides by it.
Light with_usable_flux(Light light, const std::string& where) {
  const Rgb f = flux(light);
  if (!std::isfinite((f.x + f.y + f.z) / 3))
    throw InputError(where, "the light's flux is too large for single precision");
  return light;
}

}  // namespace

LightTexture TextureLookup::operator()(TextureIndex texture, const std::string& where) const {
  textures_->visit_attributes(texture.value, [&](const MeshAttributeDescription& attribute, const Rgb&) {
    throw InputError(where, "a light cannot have the mesh attribute '" + attribute.name + "' as its texture");
  });
  if (textures_->shows_volume(texture.value)) throw InputError(where, "a light cannot have a volume as its texture");
  return [textures = textures_, texture](const Vec2<float>& uv) { return textures->colour(texture.value, uv); };
}

namespace {

Light beam_of(const Surface& surface, const Rgb& irradiance) {
  if (const auto* disk = std::get_if<Disk>(&surface.geometry))
    return BeamLight({disk->center, disk->axis_x, disk->axis_y, disk->normal, true}, irradiance);
  const auto& quad = std::get<Quad>(surface.geometry);  // the parser refuses other shapes
  const Vec3f half_u = quad.edge_u * 0.5f, half_v = quad.edge_v * 0.5f;
  return BeamLight({quad.corner + half_u + half_v, half_u, half_v, quad.normal, false}, irradiance);
}

}  // namespace

Light compile_surface_light(const Surface& surface, const ShapeDescription& shape, const Transform& to_world,
                            const TextureLookup& texture, const std::string& where) {
  const LightShaper shaper{surface, shape, to_world, where};
  const auto compile = Overloaded{[&](TextureIndex index) -> Light {
                                    return AreaLight(std::visit(shaper, surface.geometry), texture(index, where));
                                  },
                                  [&](const RgbD& radiance) {
                                    if (shape.emits_along_normal) return beam_of(surface, Rgb(radiance));
                                    return shape.emits_by_vertex_normals ? smooth_mesh_light(surface, Rgb(radiance))
                                                                         : plain_light(shaper, Rgb(radiance));
                                  }};
  return with_usable_flux(std::visit(compile, *shape.radiance), where);
}

Light compile_light(const EmitterDescription& emitter, const Vec3d& moved, const SceneBall& ball,
                    const TextureLookup& texture, const std::string& where) {
  return with_usable_flux(std::visit(Compiler{moved, ball, texture, where}, emitter.light), where);
}

}  // namespace photonproof::inline renderer_lights
