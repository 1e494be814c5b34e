// What a scene file says, as plain values: the exchange type between parser, writer, renderer and POV-Ray export.
// Meaning, orientation and defaults are Mitsuba 3's. Lengths in scene units; radiance W m^-2 sr^-1; intensity W sr^-1.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/description/material_description.h"
#include "scenes/description/transform.h"
#include "scenes/images/image.h"
#include "scenes/meshes/ies.h"
#include "scenes/meshes/mesh.h"
#include "scenes/meshes/vec.h"
#include "scenes/text/input_error.h"

namespace photonproof {

// --- Media -----------------------------------------------------------------------------------------------------------

/// Henyey and Greenstein 1941; g = 0 is isotropic. g > 0 scatters forward.
struct HenyeyGreensteinDescription {
  double g = 0.8;
  friend bool operator==(const HenyeyGreensteinDescription&, const HenyeyGreensteinDescription&) = default;
};
struct IsotropicDescription {
  friend bool operator==(const IsotropicDescription&, const IsotropicDescription&) = default;
};

/// Extinction sigma_t x scale per scene unit, of which `albedo` scatters.
struct HomogeneousDescription {
  RgbD sigma_t{1.0};
  RgbD albedo{0.75};
  double scale = 1;
  std::variant<IsotropicDescription, HenyeyGreensteinDescription> phase = {};
  friend bool operator==(const HomogeneousDescription&, const HomogeneousDescription&) = default;
};

struct MediumDescription {
  SourceLoc loc;
  std::string id;
  std::variant<HomogeneousDescription> model;
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
/// The unit disc in the local xy plane, normal +z; `to_world` leaves it a circle.
struct DiskDescription {
  friend bool operator==(const DiskDescription&, const DiskDescription&) = default;
};
/// [-1,1]^3, normals outward.
struct CubeDescription {
  friend bool operator==(const CubeDescription&, const CubeDescription&) = default;
};
/// The curved side of a cylinder from p0 to p1, open at both ends, normals outward. `to_world` must be a similarity.
struct CylinderDescription {
  Vec3d p0{0, 0, 0}, p1{0, 0, 1};
  double radius = 1;
  friend bool operator==(const CylinderDescription&, const CylinderDescription&) = default;
};
/// Extension: the whole local xy plane, normal +z; uv = local xy. It does not emit.
struct PlaneDescription {
  friend bool operator==(const PlaneDescription&, const PlaneDescription&) = default;
};

/// A mesh of triangles. After to_world the normal of a triangle is that of its corners counter-clockwise: as in
/// Mitsuba, a mirroring to_world turns it, other than with the shapes above. Unless `face_normals`, shading
/// interpolates the mesh's vertex normals (transformed by the inverse transpose, normalised); Mitsuba computes the ones
/// a file lacks as the mean of the adjoining triangles' normals, weighted by their angles at the vertex (Thuermer and
/// Wuethrich 1998). What is kept here is the file's.
struct MeshDescription {
  enum class Format { ply, obj };
  Format format = Format::ply;
  std::string filename;  ///< as the scene spells it
  bool face_normals = false;
  bool flip_tex_coords = false;              ///< v becomes 1 - v; the default of an OBJ is true, of a PLY false
  std::shared_ptr<const TriangleMesh> mesh;  ///< never null; shared by the shapes that name the same file
  friend bool operator==(const MeshDescription& a, const MeshDescription& b) {
    return a.format == b.format && a.filename == b.filename && a.face_normals == b.face_normals &&
           a.flip_tex_coords == b.flip_tex_coords && (a.mesh == b.mesh || (a.mesh && b.mesh && *a.mesh == *b.mesh));
  }
};

struct HeightfieldNoise {
  double frequency_x = 1, frequency_y = 1;  ///< lattice cells per local unit
  int octaves = 1;                          ///< each twice the frequency and half the height of the one before
  std::uint32_t seed = 0;
  friend bool operator==(const HeightfieldNoise&, const HeightfieldNoise&) = default;
};

/// Extension: z(x, y) over [-1,1]^2 of the local xy plane, columns x rows cells of two triangles, uv over the square.
/// Heights come from a bitmap (its mean channel times `amplitude`) or from gradient noise in +-amplitude.
struct HeightfieldDescription {
  using Noise = HeightfieldNoise;
  int columns = 64, rows = 64;
  double amplitude = 1;
  bool face_normals = false;
  std::variant<Noise, TextureIndex> height;
  friend bool operator==(const HeightfieldDescription&, const HeightfieldDescription&) = default;
};

/// A copy of a group of shapes, placed by to_world. The BSDFs are the group's: the instance's own index means nothing.
struct InstanceDescription {
  ShapeGroupIndex group;
  friend bool operator==(const InstanceDescription&, const InstanceDescription&) = default;
};

struct ShapeDescription {
  SourceLoc loc;
  std::string id;
  std::variant<SphereDescription, RectangleDescription, CubeDescription, MeshDescription, DiskDescription,
               CylinderDescription, PlaneDescription, HeightfieldDescription, InstanceDescription>
      geometry;
  Transform to_world;
  bool flip_normals = false;
  BsdfIndex bsdf;
  std::optional<Colour> radiance;                 ///< of an area emitter on the side the normal points to
  std::optional<MediumIndex> interior, exterior;  ///< behind the surface and before it
};

/// Shapes that are there only where instances put them; they do not emit.
struct ShapeGroupDescription {
  SourceLoc loc;
  std::string id;
  std::vector<ShapeDescription> shapes;
};

// --- Emitters that are no surface ------------------------------------------------------------------------------------

struct PointLightDescription {
  Vec3d position{0, 0, 0};  ///< world space, to_world applied
  RgbD intensity{1.0};
  friend bool operator==(const PointLightDescription&, const PointLightDescription&) = default;
};

/// Shines along local +z: in full within the beam, falling linearly with the angle to nothing at the cut-off. `texture`
/// is projected through the cut-off cone's square.
struct SpotLightDescription {
  Transform to_world;
  RgbD intensity{1.0};
  double cutoff_degrees = 20;  ///< half angle
  double beam_degrees = 15;    ///< half angle
  std::optional<TextureIndex> texture = {};
  friend bool operator==(const SpotLightDescription&, const SpotLightDescription&) = default;
};

struct DirectionalLightDescription {
  Vec3d direction{0, 0, 1};  ///< world space, unit: where the light travels
  RgbD irradiance{1.0};      ///< on a surface that faces it
  friend bool operator==(const DirectionalLightDescription&, const DirectionalLightDescription&) = default;
};

struct ConstantLightDescription {
  RgbD radiance{1.0};
  friend bool operator==(const ConstantLightDescription&, const ConstantLightDescription&) = default;
};

/// Latitude-longitude image of the radiance from all around: +y up, the middle of the image towards local +z, +x to the
/// left of it, as in Mitsuba.
struct EnvmapDescription {
  std::string filename;
  std::shared_ptr<const Image> image;  ///< never null
  double scale = 1;
  Transform to_world;
  friend bool operator==(const EnvmapDescription& a, const EnvmapDescription& b) {
    return a.filename == b.filename && a.scale == b.scale && a.to_world == b.to_world;
  }
};

/// Sun and clear sky; local +z is up, as in Mitsuba's sunsky. The parser turns place and time into the direction.
struct SunSkyDescription {
  Vec3d sun_direction{0, 0, 1};  ///< local, unit, towards the sun
  double turbidity = 3;
  RgbD albedo{0.3};  ///< of the ground
  double sun_scale = 1, sky_scale = 1;
  double sun_aperture_degrees = 0.5358;  ///< full angle
  Transform to_world;
  friend bool operator==(const SunSkyDescription&, const SunSkyDescription&) = default;
};

/// Extension: a point light with the measured distribution of an IES LM-63 file. The luminaire's nadir is local -z, its
/// C0 plane local +x. Candela count as W sr^-1, times `intensity`.
struct IesLightDescription {
  std::string filename;
  std::shared_ptr<const IesProfile> profile;  ///< never null
  RgbD intensity{1.0};
  Transform to_world;
  friend bool operator==(const IesLightDescription& a, const IesLightDescription& b) {
    return a.filename == b.filename && a.intensity == b.intensity && a.to_world == b.to_world;
  }
};

struct EmitterDescription {
  SourceLoc loc;
  std::string id;
  std::variant<PointLightDescription, SpotLightDescription, DirectionalLightDescription, ConstantLightDescription,
               EnvmapDescription, SunSkyDescription, IesLightDescription>
      light;
};

// --- Sensor, film, integrator ----------------------------------------------------------------------------------------

enum class FovAxis { x, y, diagonal, smaller, larger };

/// Looks along local +z, +y up, +x left in the image (Mitsuba's). Rays start on the plane z = near_clip.
struct PerspectiveDescription {
  double fov_degrees = 50;  ///< full angle, along `fov_axis`; the parser converts `focal_length`
  FovAxis fov_axis = FovAxis::x;
  double near_clip = 1e-2;
  double far_clip = 1e4;
  double principal_x = 0, principal_y = 0;  ///< offset of the principal point, fractions of the film's width and height
  friend bool operator==(const PerspectiveDescription&, const PerspectiveDescription&) = default;
};
/// The perspective camera through a lens of this radius, sharp at this distance along local +z.
struct ThinLensDescription {
  PerspectiveDescription perspective;
  double aperture_radius = 0;
  double focus_distance = 1;
  friend bool operator==(const ThinLensDescription&, const ThinLensDescription&) = default;
};
/// Parallel rays along local +z; the film's width spans local x in [-1,1], which to_world may scale.
struct OrthographicDescription {
  double near_clip = 1e-2;
  double far_clip = 1e4;
  friend bool operator==(const OrthographicDescription&, const OrthographicDescription&) = default;
};
/// Extension: equidistant fisheye, the angle from local +z in proportion to the distance from the image's middle;
/// `fov_degrees` is the full angle across the shorter side. Beyond the circle of that angle pixels are black.
struct FisheyeDescription {
  double fov_degrees = 180;
  double near_clip = 1e-2;
  double far_clip = 1e4;
  friend bool operator==(const FisheyeDescription&, const FisheyeDescription&) = default;
};

/// Pixels: box radius 0.5; tent radius 1; Gaussian of this deviation, cut at 4 deviations and shifted to 0 there.
struct ReconstructionFilter {
  enum class Kind { box, tent, gaussian };
  Kind kind = Kind::gaussian;
  double stddev = 0.5;
  double radius = 1;  ///< of the tent
  friend bool operator==(const ReconstructionFilter&, const ReconstructionFilter&) = default;
};

struct FilmDescription {
  int width = 768;
  int height = 576;
  ReconstructionFilter filter = {.kind = ReconstructionFilter::Kind::box};
  /// The part of the image that is rendered: {x, y, width, height}; the whole when empty.
  struct Crop {
    int x = 0, y = 0, width = 0, height = 0;
    friend bool operator==(const Crop&, const Crop&) = default;
  };
  std::optional<Crop> crop = {};
  friend bool operator==(const FilmDescription&, const FilmDescription&) = default;
};

struct SensorDescription {
  SourceLoc loc;
  std::string id;
  std::variant<PerspectiveDescription, ThinLensDescription, OrthographicDescription, FisheyeDescription> camera;
  Transform to_world;
  FilmDescription film;
  int sample_count = 4;
  std::optional<MediumIndex> medium;  ///< around the camera
};

/// What all integrators know. `max_depth` counts path edges as Mitsuba does (1 = emitters only, 2 = direct light); -1
/// is unlimited.
struct PathLimits {
  int max_depth = -1;
  int rr_depth = 5;  ///< Russian roulette from this depth on
  bool hide_emitters = false;
  friend bool operator==(const PathLimits&, const PathLimits&) = default;
};

/// Path tracing with next-event estimation; media are ignored by none: it refuses scenes that have some.
struct PathDescription : PathLimits {
  friend bool operator==(const PathDescription&, const PathDescription&) = default;
};
/// Path tracing through participating media and nested dielectrics.
struct VolPathDescription : PathLimits {
  friend bool operator==(const VolPathDescription&, const VolPathDescription&) = default;
};
/// Bidirectional path tracing with multiple importance sampling over all strategies.
struct BdptDescription : PathLimits {
  friend bool operator==(const BdptDescription&, const BdptDescription&) = default;
};
/// Light tracing: paths start at the lights, every vertex is connected to the camera.
struct ParticleTracerDescription : PathLimits {
  friend bool operator==(const ParticleTracerDescription&, const ParticleTracerDescription&) = default;
};
/// Direct light only; max_depth and rr_depth are not its parameters. `emitter_samples` and `bsdf_samples` a camera
/// sample, weighted against each other.
struct DirectDescription : PathLimits {
  int emitter_samples = 1, bsdf_samples = 1;
  friend bool operator==(const DirectDescription&, const DirectDescription&) = default;
};
/// Whitted 1980: both branches at smooth dielectrics, mirrors, direct light everywhere else, and no further.
struct WhittedDescription : PathLimits {
  friend bool operator==(const WhittedDescription&, const WhittedDescription&) = default;
};

/// Fixed-radius photon mapping with a global and a caustic map. A radius of 0 asks for the automatic choice.
struct PhotonMapperDescription : PathLimits {
  std::int64_t global_photons = 1'000'000;   ///< emitted for the global map, over the whole render
  std::int64_t caustic_photons = 1'000'000;  ///< emitted for the caustic map, over the whole render
  double global_radius = 0;                  ///< scene units
  double caustic_radius = 0;                 ///< scene units
  friend bool operator==(const PhotonMapperDescription&, const PhotonMapperDescription&) = default;
};

struct IntegratorDescription {
  SourceLoc loc;
  std::variant<PathDescription, PhotonMapperDescription, VolPathDescription, BdptDescription, ParticleTracerDescription,
               DirectDescription, WhittedDescription>
      method;

  const PathLimits& limits() const {
    return std::visit([](const auto& m) -> const PathLimits& { return m; }, method);
  }
};

struct SceneDescription {
  std::vector<std::string> files;  ///< files read, the scene itself first
  std::vector<TextureDescription> textures;
  std::vector<BsdfDescription> bsdfs;
  std::vector<MediumDescription> media;
  std::vector<ShapeGroupDescription> groups;
  std::vector<ShapeDescription> shapes;
  std::vector<EmitterDescription> emitters;
  SensorDescription sensor;
  IntegratorDescription integrator;

  /// "file:line:col" of an entity, for messages of later stages.
  std::string where(const SourceLoc& loc) const;
};

}  // namespace photonproof
