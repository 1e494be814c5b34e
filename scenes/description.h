// What a scene file says, as plain values: the exchange type between parser, writer, renderer and POV-Ray export.
// Meaning, orientation and defaults are Mitsuba 3's. Lengths in scene units; radiance W m^-2 sr^-1; intensity W sr^-1.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/input_error.h"
#include "scenes/mesh.h"
#include "scenes/transform.h"
#include "scenes/vec.h"

namespace photonproof {

/// A typed index into one of SceneDescription's tables.
template <class Tag>
struct Index {
  std::uint32_t value = 0;
  friend auto operator<=>(const Index&, const Index&) = default;
};
using BsdfIndex = Index<struct BsdfTag>;

// --- BSDFs -----------------------------------------------------------------------------------------------------------

/// Lambertian, one-sided: black from behind (the side its normal does not point to).
struct DiffuseDescription {
  RgbD reflectance{0.5};
  friend bool operator==(const DiffuseDescription&, const DiffuseDescription&) = default;
};

/// Smooth conductor, one-sided. Without `ior` it reflects `specular_reflectance` at every angle (material "none").
struct ConductorDescription {
  struct ComplexIor {
    RgbD eta, k;
    friend bool operator==(const ComplexIor&, const ComplexIor&) = default;
  };
  std::optional<ComplexIor> ior;
  RgbD specular_reflectance{1.0};
  friend bool operator==(const ConductorDescription&, const ConductorDescription&) = default;
};

/// Smooth dielectric; the normal points to the exterior.
struct DielectricDescription {
  double int_ior = 1.5046;    // bk7
  double ext_ior = 1.000277;  // air
  RgbD specular_reflectance{1.0};
  RgbD specular_transmittance{1.0};
  friend bool operator==(const DielectricDescription&, const DielectricDescription&) = default;
};

struct BsdfDescription {
  SourceLoc loc;
  std::string id;  ///< empty when unnamed
  std::variant<DiffuseDescription, ConductorDescription, DielectricDescription> model;
};

// --- Shapes ----------------------------------------------------------------------------------------------------------

/// Before `to_world`: centre and radius. `to_world` must be a similarity; the normal points outward.
struct SphereDescription {
  Vec3d center{0, 0, 0};
  double radius = 1;
  friend bool operator==(const SphereDescription&, const SphereDescription&) = default;
};
/// [-1,1]^2 in the local xy plane, normal +z.
struct RectangleDescription {
  friend bool operator==(const RectangleDescription&, const RectangleDescription&) = default;
};
/// [-1,1]^3, normals outward.
struct CubeDescription {
  friend bool operator==(const CubeDescription&, const CubeDescription&) = default;
};

/// A mesh of triangles. After to_world the normal of a triangle is that of its corners counter-clockwise: as in
/// Mitsuba, a mirroring to_world turns it, other than with the shapes above. Unless `face_normals`, shading
/// interpolates the mesh's vertex normals (transformed by the inverse transpose, normalised); Mitsuba computes the ones
/// a file lacks as the mean of the adjoining triangles' normals, weighted by their angles at the vertex (Thuermer and
/// Wuethrich 1998). What is kept here is the file's.
struct PlyDescription {
  std::string filename;  ///< as the scene spells it, relative to the scene's folder
  bool face_normals = false;
  std::shared_ptr<const TriangleMesh> mesh;  ///< never null; shared by the shapes that name the same file
  friend bool operator==(const PlyDescription& a, const PlyDescription& b) {
    return a.filename == b.filename && a.face_normals == b.face_normals &&
           (a.mesh == b.mesh || (a.mesh && b.mesh && *a.mesh == *b.mesh));
  }
};

struct ShapeDescription {
  SourceLoc loc;
  std::string id;
  std::variant<SphereDescription, RectangleDescription, CubeDescription, PlyDescription> geometry;
  Transform to_world;
  bool flip_normals = false;
  BsdfIndex bsdf;
  std::optional<RgbD> radiance;  ///< of an area emitter on the side the normal points to
};

// --- Emitters that are no surface ------------------------------------------------------------------------------------

struct PointLightDescription {
  Vec3d position{0, 0, 0};  ///< world space, to_world applied
  RgbD intensity{1.0};
  friend bool operator==(const PointLightDescription&, const PointLightDescription&) = default;
};

struct EmitterDescription {
  SourceLoc loc;
  std::string id;
  std::variant<PointLightDescription> light;
};

// --- Sensor, film, integrator ----------------------------------------------------------------------------------------

enum class FovAxis { x, y, diagonal, smaller, larger };

/// Looks along local +z, +y up, +x left in the image (Mitsuba's). Rays start on the plane z = near_clip.
struct PerspectiveDescription {
  double fov_degrees = 50;  ///< full angle, along `fov_axis`; the parser converts `focal_length`
  FovAxis fov_axis = FovAxis::x;
  double near_clip = 1e-2;
  double far_clip = 1e4;
  friend bool operator==(const PerspectiveDescription&, const PerspectiveDescription&) = default;
};

struct FilmDescription {
  int width = 768;
  int height = 576;
  // Only the box reconstruction filter exists so far; the parser refuses a film that does not name it.
  friend bool operator==(const FilmDescription&, const FilmDescription&) = default;
};

struct SensorDescription {
  SourceLoc loc;
  std::string id;
  std::variant<PerspectiveDescription> camera;
  Transform to_world;
  FilmDescription film;
  int sample_count = 4;
};

/// `max_depth` counts path edges as Mitsuba does (1 = emitters only, 2 = direct light); -1 is unlimited.
struct PathDescription {
  int max_depth = -1;
  int rr_depth = 5;  ///< Russian roulette from this depth on
  bool hide_emitters = false;
  friend bool operator==(const PathDescription&, const PathDescription&) = default;
};

/// Fixed-radius photon mapping with a global and a caustic map. A radius of 0 asks for the automatic choice.
struct PhotonMapperDescription {
  int max_depth = -1;
  int rr_depth = 5;
  bool hide_emitters = false;
  std::int64_t global_photons = 1'000'000;   ///< emitted for the global map, over the whole render
  std::int64_t caustic_photons = 1'000'000;  ///< emitted for the caustic map, over the whole render
  double global_radius = 0;                  ///< scene units
  double caustic_radius = 0;                 ///< scene units
  friend bool operator==(const PhotonMapperDescription&, const PhotonMapperDescription&) = default;
};

struct IntegratorDescription {
  SourceLoc loc;
  std::variant<PathDescription, PhotonMapperDescription> method;
};

struct SceneDescription {
  std::vector<std::string> files;  ///< files read, the scene itself first
  std::vector<BsdfDescription> bsdfs;
  std::vector<ShapeDescription> shapes;
  std::vector<EmitterDescription> emitters;
  SensorDescription sensor;
  IntegratorDescription integrator;

  /// "file:line:col" of an entity, for messages of later stages.
  std::string where(const SourceLoc& loc) const;
};

}  // namespace photonproof
