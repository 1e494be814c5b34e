// From a scene's description to PovScene.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "reference/engines/heightfield_mesh.h"
#include "reference/optics/sky_lights.h"
#include "reference/povray/povray_overlap.h"
#include "reference/povray/povray_scene.h"
#include "reference/povray/unrepresentable.h"
#include "scenes/description/overloaded.h"
#include "scenes/meshes/convex_clip.h"

namespace photonproof::inline reference_povray {
namespace {

/// Half the side of the square that stands for a plane, in radii of everything else: the horizon is a thousandth of a
/// radian low.
constexpr double kEndless = 1000;

/// The image of [-1,1]^2 under `t`. A mirrored transform turns the winding but not Mitsuba's normal (inverse
/// transpose).
PovParallelogram parallelogram(const Transform& t, bool flip) {
  const PovParallelogram p{t.point({-1, -1, 0}), t.vector({2, 0, 0}), t.vector({0, 2, 0})};
  if (flip != (t.determinant() < 0)) return {p.corner, p.edge_v, p.edge_u};
  return p;
}

bool is_texture(const Colour& colour) { return std::holds_alternative<TextureIndex>(colour); }

bool emits(const SceneDescription& scene, const ShapeDescription& shape) {
  return shape.radiance && range_of(scene, *shape.radiance).greatest > 0;
}

void check_emitters(const SceneDescription& scene) {
  for (const EmitterDescription& emitter : scene.emitters) {
    const auto* spot = std::get_if<SpotLightDescription>(&emitter.light);
    if (spot && spot->texture) range_of(scene, *spot->texture);
    if (std::holds_alternative<ProjectorDescription>(emitter.light))
      throw Unrepresentable(scene.where(emitter.loc), "a projector: not written yet; a spot with a texture can be");
  }
}

void check_film(const SceneDescription& scene) {
  if (scene.sensor.medium)
    throw Unrepresentable(scene.where(scene.sensor.loc),
                          "a camera in a medium: POV-Ray scatters light once only, and its lights ignore theirs");
}

/// As in Mitsuba, every face of a cube has the whole square of uv. The table has its corner (1, 1), in the order of
/// PovBox::faces. Seen from outside v is clockwise of u.
Transform uv_of_cube_face(const Transform& to_world, std::size_t face) {
  constexpr std::array<Vec3d, 6> normals{Vec3d{1, 0, 0},  Vec3d{-1, 0, 0}, Vec3d{0, 1, 0},
                                         Vec3d{0, -1, 0}, Vec3d{0, 0, 1},  Vec3d{0, 0, -1}};
  constexpr std::array<Vec3d, 6> corners{Vec3d{1, 1, -1}, Vec3d{-1, 1, 1}, Vec3d{-1, 1, -1},
                                         Vec3d{1, -1, 1}, Vec3d{1, 1, 1},  Vec3d{1, -1, -1}};
  const Vec3d n = normals[face], diagonal = (corners[face] - n) * 2.0;
  const Vec3d u = (diagonal - cross(diagonal, n)) * 0.5, v = diagonal - u, origin = n - diagonal * 0.5;
  Transform t;
  t.m = {u.x, v.x, n.x, origin.x, u.y, v.y, n.y, origin.y, u.z, v.z, n.z, origin.z, 0, 0, 0, 1};
  return to_world * t;
}

/// Irradiance at `p` from a flat light's front as a share of a uniform sky's, unoccluded. It is Lambert's sum over the
/// edges of the part above the surface (Lambert 1760).
double share_of_sky(const Vec3d& p, const Vec3d& n, const PovParallelogram& area_light) {
  if (dot(area_light.normal(), p - area_light.corner) <= 0) return 0;
  const auto vertices = area_light.vertices();
  const std::array<HalfSpace, 1> above{HalfSpace{-n, -dot(n, p)}};
  const std::vector<Vec3d> seen = clip_polygon({vertices.begin(), vertices.end()}, above);
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3d a = normalize(seen[i] - p), b = normalize(seen[(i + 1) % seen.size()] - p), across = cross(a, b);
    const double sine = length(across);
    if (sine > 0) sum += std::atan2(sine, dot(a, b)) / sine * dot(across, n);
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

/// The least share among places spread over the flat diffuse surfaces, of those that see any of it; 0 where a surface
/// is of another kind, or none sees it.
double least_share(const PovScene& scene, const PovParallelogram& area_light) {
  constexpr int side = 8;
  double least = 1;
  bool seen = false;
  for (const PovSurface& surface : scene.surfaces) {
    if (!is_diffuse(surface)) continue;
    const auto* face = std::get_if<PovParallelogram>(&surface.geometry);
    if (!face) return 0;
    for (int i = 0; i < side * side; ++i) {
      const double u = (i % side + 0.5) / side, v = (i / side + 0.5) / side;
      const double share = share_of_sky(face->corner + face->edge_u * u + face->edge_v * v, face->normal(), area_light);
      if (share <= 0) continue;
      seen = true;
      least = std::min(least, share);
    }
  }
  return seen ? least : 0;
}

/// Radiosity's rays find a light that fills half the sky of the surfaces it lights, as they find a light around the
/// scene. Point lights on it would be as far from one another as from those surfaces.
void leave_wide_lights_to_radiosity(PovScene& scene) {
  for (PovSurface& surface : scene.surfaces) {
    const auto* face = std::get_if<PovParallelogram>(&surface.geometry);
    if (surface.emission == PovSurface::Emission::spots && face && least_share(scene, *face) >= 0.5)
      surface.emission = PovSurface::Emission::radiosity;
  }
}

class Lowering {
 public:
  explicit Lowering(const SceneDescription& description) { scene_.description = &description; }

  PovScene run() {
    const SceneDescription& description = *scene_.description;
    check_emitters(description);
    check_film(description);
    for (const ShapeDescription& shape : description.shapes) add_shape(shape);
    add_sky();
    bound();
    for (const ShapeDescription* plane : planes_) add_plane(*plane);
    leave_wide_lights_to_radiosity(scene_);
    check_whole();
    // Mirrors and glass would need the lights' photons: there radiosity's rays find the sky, through them, too.
    const auto any = [&](bool (*is)(const PovSurface&)) {
      return std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(), is);
    };
    scene_.sky_as_lights = scene_.sky && std::holds_alternative<EnvmapDescription>(scene_.sky->light) &&
                           any(is_diffuse) && !any(is_specular);
    refuse_overlaps_with_glass(scene_);
    return std::move(scene_);
  }

 private:
  void add_sky() {
    const SceneDescription& description = *scene_.description;
    for (const EmitterDescription& emitter : description.emitters) {
      if (!is_sky(emitter)) continue;
      if (scene_.sky) throw Unrepresentable(description.where(emitter.loc), "a second light from all around");
      scene_.sky = &emitter;
      scene_.sun = std::get_if<SunSkyDescription>(&emitter.light);
      if (!scene_.sun) continue;
      scene_.baked_sky = std::make_shared<const EmitterDescription>(sky_without_sun(emitter));
      scene_.sky = scene_.baked_sky.get();
    }
  }

  void add_shape(const ShapeDescription& shape) {
    if (const auto* instance = std::get_if<InstanceDescription>(&shape.geometry)) {
      for (const ShapeDescription& of : scene_.description->groups[instance->group.value].shapes) {
        ShapeDescription copy = of;
        copy.to_world = shape.to_world * of.to_world;
        copy.loc = shape.loc;
        scene_.copies->push_back(std::move(copy));
        add_shape(scene_.copies->back());
      }
      return;
    }
    if (std::holds_alternative<PlaneDescription>(shape.geometry)) {
      planes_.push_back(&shape);  // its necessary size follows from the other shapes
      return;
    }
    const std::optional<PovSurface> surface = start(shape);
    if (!surface) return;
    std::visit([&](const auto& geometry) { place(*surface, geometry); }, shape.geometry);
  }

  /// A surface without its geometry; empty when the shape has no surface.
  std::optional<PovSurface> start(const ShapeDescription& shape) const {
    const SceneDescription& description = *scene_.description;
    PovSurface surface;
    surface.shape = &shape;
    surface.sides = resolve_bsdf(description, shape.bsdf);
    surface.absorption = absorption_behind(shape);
    if (surface.sides.nothing && !surface.absorption) {
      if (emits(description, shape))
        throw Unrepresentable(description.where(shape.loc), "a light without a surface; its bsdf must be diffuse");
      return std::nullopt;
    }
    if (!surface.sides.nothing) {
      surface.optics = optics_of(description, *surface.sides.front);
      if (surface.sides.back) {
        const PovOptics back = optics_of(description, *surface.sides.back);
        if (back.diffuse.greatest > surface.optics.diffuse.greatest) surface.optics.diffuse = back.diffuse;
        surface.optics.specular |= back.specular;
      }
    }
    if (shape.emits_along_normal)
      throw Unrepresentable(description.where(shape.loc), "a light that shines along its normal: not written yet");
    if (emits(description, shape)) {
      surface.emission = PovSurface::Emission::spots;
      if (is_texture(*shape.radiance)) surface.emission = PovSurface::Emission::picture;
      const bool closed = std::holds_alternative<SphereDescription>(shape.geometry) ||
                          std::holds_alternative<CubeDescription>(shape.geometry);
      if (closed && shape.flip_normals && !is_texture(*shape.radiance))
        surface.emission = PovSurface::Emission::radiosity;
    }
    return surface;
  }

  std::optional<RgbD> absorption_behind(const ShapeDescription& shape) const {
    const SceneDescription& description = *scene_.description;
    if (!shape.interior && !shape.exterior) return std::nullopt;
    if (shape.exterior)
      throw Unrepresentable(description.where(shape.loc), "a medium before a surface; one inside it can be written");
    const MediumDescription& described = description.media[shape.interior->value];
    if (described.varies())
      throw Unrepresentable(description.where(shape.loc),
                            "a medium that varies: the export writes homogeneous media alone");
    const auto& medium = std::get<HomogeneousDescription>(described.model);
    if (max_component(bounds_of(described).scattering) > 0)
      throw Unrepresentable(description.where(shape.loc),
                            "a medium that scatters: POV-Ray scatters light once at most; one that only absorbs can be "
                            "written");
    return medium.sigma_t * medium.scale;
  }

  void add(PovSurface surface, const PovGeometry& geometry) {
    surface.geometry = geometry;
    check(surface);
    scene_.surfaces.push_back(std::move(surface));
  }

  void place(PovSurface surface, const SphereDescription& sphere) {
    const Transform& t = surface.shape->to_world;
    const double scale = std::cbrt(std::abs(t.determinant()));
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
      if (std::abs(length(t.vector(axis)) - scale) > 1e-5 * scale)
        throw Unrepresentable(scene_.description->where(surface.shape->loc), "a stretched sphere");
    surface.uv = t * Transform::translate(sphere.center);
    surface.uv_kind = PovUv::sphere;
    add(surface, PovSphere{t.point(sphere.center), sphere.radius * scale, surface.shape->flip_normals});
  }

  void place(PovSurface surface, const RectangleDescription&) {
    const Transform& t = surface.shape->to_world;
    surface.uv = t * Transform::translate({-1, -1, 0}) * Transform::scale({2, 2, 1});
    add(surface, parallelogram(t, surface.shape->flip_normals));
  }

  void place(PovSurface surface, const CubeDescription&) {
    const ShapeDescription& shape = *surface.shape;
    const PovBox box{shape.to_world, shape.flip_normals};
    const bool emitting = surface.emission != PovSurface::Emission::none;
    const bool closed = is_glass(surface) || surface.sides.nothing;
    if (closed || (!emitting && !shape.flip_normals && !is_textured_anywhere(surface))) return add(surface, box);
    const auto sides = box.faces();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      surface.uv = uv_of_cube_face(shape.to_world, i);
      add(surface, sides[i]);
    }
  }

  void place(const PovSurface& surface, const MeshDescription& mesh) {
    add(surface, place_mesh(*surface.shape, mesh.mesh, !mesh.face_normals, scene_.surfaces.size()));
  }

  void place(const PovSurface& surface, const HeightfieldDescription& field) {
    add(surface, place_mesh(*surface.shape, heightfield_mesh(*scene_.description, field, "POV-Ray"),
                            !field.face_normals, scene_.surfaces.size()));
  }

  void place(PovSurface surface, const DiskDescription&) {
    const Transform& t = surface.shape->to_world;
    if (std::abs(length(t.vector({0, 1, 0})) / length(t.vector({1, 0, 0})) - 1) > 1e-5)
      throw Unrepresentable(scene_.description->where(surface.shape->loc), "a disk that is an ellipse");
    surface.uv = t;
    surface.uv_kind = PovUv::disk;
    add(surface, PovRound{PovRound::Kind::disk, t, surface.shape->flip_normals});
  }

  void place(PovSurface surface, const CylinderDescription& cylinder) {
    const Vec3d axis = cylinder.p1 - cylinder.p0;
    const Vec3d z = normalize(axis);
    // Origin of the angle in uv: the frame of Duff et al. 2017.
    const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    const Vec3d x{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, y{b, sign + z.y * z.y * a, -z.y};
    const double r = cylinder.radius;
    Transform frame;
    frame.m = {x.x * r, y.x * r, axis.x, cylinder.p0.x, x.y * r, y.y * r, axis.y, cylinder.p0.y,
               x.z * r, y.z * r, axis.z, cylinder.p0.z, 0,       0,       0,      1};
    surface.uv = surface.shape->to_world * frame;
    surface.uv_kind = PovUv::cylinder;
    add(surface, PovRound{PovRound::Kind::cylinder, surface.shape->to_world * frame, surface.shape->flip_normals});
  }

  void place(const PovSurface& surface, const CurvesDescription&) {
    throw Unrepresentable(scene_.description->where(surface.shape->loc),
                          "curves: POV-Ray's sphere_sweep has round ends, is solid and has no texture coordinates");
  }

  void place(const PovSurface& surface, const SdfGridDescription&) {
    throw Unrepresentable(scene_.description->where(surface.shape->loc),
                          "a grid of signed distances: POV-Ray finds zeros of functions in steps");
  }

  void place(const PovSurface& surface, const EllipsoidsDescription&) {
    throw Unrepresentable(scene_.description->where(surface.shape->loc),
                          "ellipsoids of a file: POV-Ray would see their inside");
  }

  template <class Other>
  void place(const PovSurface&, const Other&) {
    throw std::logic_error("planes and instances are not placed as they are");
  }

  void add_plane(const ShapeDescription& shape) {
    std::optional<PovSurface> surface = start(shape);
    if (!surface) return;
    // Its part below the middle of everything, in the middle of the square.
    const Transform& t = shape.to_world;
    const auto inverse = t.inverse();
    if (!inverse) throw Unrepresentable(scene_.description->where(shape.loc), "a plane whose to_world has no inverse");
    const Vec3d middle = inverse->point(scene_.center);
    const double unit = std::min(length(t.vector({1, 0, 0})), length(t.vector({0, 1, 0})));
    const double half = kEndless * scene_.radius / unit;
    surface->uv = t;
    surface->endless = true;
    add(*surface, parallelogram(t * Transform::translate({middle.x, middle.y, 0}) * Transform::scale({half, half, 1}),
                                shape.flip_normals));
  }

  bool is_textured_anywhere(const PovSurface& surface) const {
    const SceneDescription& description = *scene_.description;
    if (surface.shape->radiance && is_texture(*surface.shape->radiance)) return true;
    return (surface.sides.front && is_textured(description, *surface.sides.front)) ||
           (surface.sides.back && is_textured(description, *surface.sides.back));
  }

  void check(const PovSurface& surface) const;
  void check_whole();
  void bound();

  PovScene scene_;
  std::vector<const ShapeDescription*> planes_;
};

void Lowering::check(const PovSurface& surface) const {
  const SceneDescription& description = *scene_.description;
  const std::string where = description.where(surface.shape->loc);
  const auto* mesh = std::get_if<PovMesh>(&surface.geometry);
  const bool closed = std::holds_alternative<PovSphere>(surface.geometry) ||
                      std::holds_alternative<PovBox>(surface.geometry) ||
                      (mesh && (is_glass(surface) || surface.absorption) && mesh->is_closed());
  if (surface.absorption && (!closed || (!mesh && surface.shape->flip_normals)))
    throw Unrepresentable(where,
                          "a medium in another shape than a sphere, a cube or a closed mesh, their front outside");
  if (is_glass(surface) && mesh && !closed)
    throw Unrepresentable(where,
                          "a triangle mesh of dielectric that is open, or whose front is inside: POV-Ray's index of "
                          "refraction belongs to a closed body");
  if (is_glass(surface) && !closed)
    throw Unrepresentable(where,
                          "an open surface of dielectric: POV-Ray's index of refraction belongs to a closed body");
  if (is_glass(surface)) {
    const auto& glass = std::get<DielectricDescription>(surface.sides.front->model);
    // Rays that enter a ball of a higher index leave it again: both angles inside are the same.
    const bool never_total = std::holds_alternative<PovSphere>(surface.geometry) && glass.int_ior >= glass.ext_ior;
    if (!never_total && !(constant(glass.specular_reflectance) == RgbD(1.0)))
      throw Unrepresentable(where,
                            "a dielectric with specular_reflectance other than 1 that is no ball: POV-Ray reflects "
                            "totally all the same");
  }
  const bool emitting = surface.emission != PovSurface::Emission::none;
  if (emitting && (is_specular(surface) || surface.sides.opacity < 1))
    throw Unrepresentable(where, "an area light on a specular surface; its bsdf must be diffuse");
  if (emitting && is_textured(description, *surface.sides.front))
    throw Unrepresentable(where, "an area light on a textured surface");
  if (is_textured_anywhere(surface) && mesh)
    throw Unrepresentable(where, "a texture on a mesh; one on another shape can be written");
}

void Lowering::check_whole() {
  const SceneDescription& description = *scene_.description;
  const bool hides = std::visit([](const auto& m) { return m.hide_emitters; }, description.integrator.method);
  for (const PovSurface& surface : scene_.surfaces) {
    const bool lit = is_diffuse(surface) || is_specular(surface);
    if (hides && surface.emission != PovSurface::Emission::none) scene_.hides_lights = true;
    if (hides && (surface.emission == PovSurface::Emission::radiosity || is_glass(surface)))
      throw Unrepresentable(description.where(description.integrator.loc),
                            "hide_emitters with glass or a light around the scene: POV-Ray cannot hide a light from "
                            "the camera and show it in glass");
    if (!lit) continue;
    if (is_diffuse(surface))
      for (const PovSurface& other : scene_.surfaces)
        if (other.absorption)
          throw Unrepresentable(
              description.where(other.shape->loc),
              "a medium that absorbs beside surfaces that are lit: POV-Ray's photons and radiosity ignore it");
    for (const PovSurface& other : scene_.surfaces)
      if (other.emission == PovSurface::Emission::picture)
        throw Unrepresentable(description.where(other.shape->loc), "a textured area light that lights other surfaces");
  }
  if (hides && scene_.sky)
    throw Unrepresentable(description.where(description.integrator.loc), "hide_emitters under a sky");
}

/// A ball around the centre of the axis-aligned box of everything.
void Lowering::bound() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3d low(inf), high(-inf);
  const auto add_point = [&](const Vec3d& p, double reach) {
    low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach), std::min(low.z, p.z - reach)};
    high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach), std::max(high.z, p.z + reach)};
  };
  for (const PovSurface& surface : scene_.surfaces) {
    const PovExtent of = extent(surface);
    for (const Vec3d& p : of.points) add_point(p, of.reach);
  }
  for (const EmitterDescription& emitter : scene_.description->emitters)
    if (const auto at = position_of(emitter)) add_point(*at, 0);
  if (low.x > high.x) return;
  scene_.center = (low + high) * 0.5;
  const double radius = length(high - low) * 0.5;
  if (radius > 0) scene_.radius = radius;
}

}  // namespace

PovScene lower_scene(const SceneDescription& description) { return Lowering(description).run(); }

}  // namespace photonproof::inline reference_povray
