#include "renderer/lights/compile_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/text/faults.h"

namespace photonproof {
namespace {

Vec3f axis(const Transform& to_world, const Vec3d& local) { return Vec3f(normalize(to_world.vector(local))); }

/// Two axes of a right-handed frame whose third is `forward`, the first of them near `right`.
std::pair<Vec3f, Vec3f> across(const Vec3f& forward, const Vec3f& right) {
  const Vec3f x = normalize(right - forward * dot(right, forward));
  return {x, cross(forward, x)};
}

// --- shapes ----------------------------------------------------------------------------------------------------------

/// A shape as light_area.h has it.
struct CompileShape {
  const ShapeDescription& shape;
  const Transform& to_world;
  const std::string& where;

  LightShape operator()(const Quad& q) const { return QuadShape{q.corner, q.edge_u, q.edge_v, q.normal}; }

  LightShape operator()(const Sphere& s) const {
    return SphereShape{s.center,
                       s.radius,
                       axis(to_world, {1, 0, 0}),
                       axis(to_world, {0, 1, 0}),
                       axis(to_world, {0, 0, 1}),
                       s.inward ? -1.0f : 1.0f};
  }

  LightShape operator()(const Mesh& mesh) const {
    std::vector<Vec3f> positions(mesh.positions.begin(), mesh.positions.end() - 1);  // the last is a spare
    std::vector<Vec2<float>> uvs = mesh.source->uvs;
    if (mesh.flip_v)
      for (Vec2<float>& uv : uvs) uv.y = 1 - uv.y;
    return MeshShape(std::move(positions), mesh.source->triangles, std::move(uvs), mesh.inward);
  }

  LightShape operator()(const Disk&) const { return disk(); }

  LightShape operator()(const Cylinder&) const {
    // Mitsuba turns the cylinder's local z to p1 - p0 by its own frame; u starts at that frame's first axis.
    const auto& c = std::get<CylinderDescription>(shape.geometry);
    const Vec3d along = c.p1 - c.p0;
    const Frame<float> frame(Vec3f(normalize(along)));
    return CylinderShape{Vec3f(to_world.point(c.p0)),
                         Vec3f(to_world.vector(along)),
                         axis(to_world, Vec3d(frame.s)),
                         axis(to_world, Vec3d(frame.t)),
                         static_cast<float>(c.radius * shape.to_world.similarity_scale()),
                         shape.flip_normals ? -1.0f : 1.0f};
  }

  LightShape operator()(const Plane&) const { throw refusal(); }
  LightShape operator()(const MeshInstance&) const { throw refusal(); }

  DiskShape disk() const {
    const Vec3d u = to_world.vector({1, 0, 0}), v = to_world.vector({0, 1, 0});
    const bool mirrored = shape.to_world.determinant() < 0;
    const Vec3d normal = normalize(cross(u, v)) * (shape.flip_normals != mirrored ? -1.0 : 1.0);
    return {Vec3f(to_world.point({0, 0, 0})), Vec3f(u), Vec3f(v), Vec3f(normal)};
  }

 private:
  InputError refusal() const { return InputError(where, "this shape cannot be a light"); }
};

/// A lamp of constant radiance: of some shapes there is a kind that kernels sample in their lanes.
struct CompilePlainLight {
  const CompileShape& shape;
  const Rgb& radiance;

  Light operator()(const Quad& q) const {
    return QuadLight<float>{q.corner, q.edge_u, q.edge_v, q.normal, q.area, radiance};
  }
  Light operator()(const Sphere& s) const {
    return SphereLight<float>{s.center, s.radius, s.inward ? -1.0f : 1.0f, radiance};
  }
  Light operator()(const Disk&) const {
    const DiskShape d = shape.disk();
    return DiskLight<float>{d.center, d.half_axis_u, d.half_axis_v, d.normal, d.area(), radiance};
  }
  template <class Other>
  Light operator()(const Other& other) const {
    return AreaLight(shape(other), radiance);
  }
};

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
    return TexturedSpotLight(spot, right, up, texture(*d.texture));
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
                       d.sun_aperture_degrees * std::numbers::pi / 180, d.to_world}));
  }

  Light operator()(const IesLightDescription& d) const {
    const Vec3f zenith = axis(d.to_world, {0, 0, 1});
    const auto [c0, c90] = across(zenith, Vec3f(d.to_world.vector({1, 0, 0})));
    return IesLight(Vec3f(d.to_world.point({0, 0, 0}) + moved), c0, c90, zenith, Rgb(d.intensity), *d.profile);
  }

 private:
  Light sky(Sky s) const { return EnvironmentLight(std::move(s), ball.center, ball.radius); }
};

/// Choosing lights divides by their flux.
Light with_usable_flux(Light light, const std::string& where) {
  const Rgb f = flux(light);
  if (!std::isfinite((f.x + f.y + f.z) / 3))
    throw InputError(where, "the light's flux is too large for single precision");
  return light;
}

}  // namespace

Light compile_surface_light(const Geometry& geometry, const ShapeDescription& shape, const Transform& to_world,
                            const TextureLookup& texture, const std::string& where) {
  const CompileShape compile{shape, to_world, where};
  if (const auto* index = std::get_if<TextureIndex>(&*shape.radiance))
    return with_usable_flux(AreaLight(std::visit(compile, geometry), texture(*index)), where);
  const Rgb radiance(constant(*shape.radiance));
  return with_usable_flux(std::visit(CompilePlainLight{compile, radiance}, geometry), where);
}

Light compile_light(const EmitterDescription& emitter, const Vec3d& moved, const SceneBall& ball,
                    const TextureLookup& texture, const std::string& where) {
  return with_usable_flux(std::visit(Compiler{moved, ball, texture, where}, emitter.light), where);
}

}  // namespace photonproof
