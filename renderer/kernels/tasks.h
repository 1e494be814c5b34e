// What the kernels are asked to do, and the table of them for one instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/ray_counts.h"
#include "renderer/kernels/gather_points.h"
#include "renderer/lanes/sampler.h"
#include "renderer/photons/photon_view.h"
#include "renderer/scene/scene_view.h"

namespace photonproof::inline renderer_kernels {

/// Camera samples [first_sample, first_sample + samples) of every pixel of a tile, or of some; at most 2^20 of them.
struct CameraTask {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::uint32_t first_sample = 0, samples = 0;
  std::uint32_t seed = 0;  ///< stream_seed of the camera
  SamplerKind sampler = SamplerKind::sobol;
  int grid = 0;                                ///< k > 0: samples on the centres of a k x k grid in the pixel
  const std::uint32_t* some_pixels = nullptr;  ///< of the tile, row by row; null: all of them
  std::uint32_t some_count = 0;

  std::uint32_t tile_width() const { return static_cast<std::uint32_t>(x1 - x0); }
  std::uint32_t pixels() const {
    return some_pixels != nullptr ? some_count : tile_width() * static_cast<std::uint32_t>(y1 - y0);
  }
  std::uint32_t pixel(std::uint32_t nth) const { return some_pixels != nullptr ? some_pixels[nth] : nth; }
  std::uint32_t paths() const { return pixels() * samples; }
};

/// How light comes to the vertices of a path.
enum class DirectLight {
  weighted,       ///< samples of lights and rays that meet them, by multiple importance sampling
  unweighted,     ///< both, where no light can be had both ways
  samples_only,   ///< rays see only lights that samples cannot have found
  hits_only,      ///< rays that meet lights, without samples
  rare_hits_only  ///< rays see only lights that samples could not have found; no samples either
};
constexpr bool takes_light_samples(DirectLight from) {
  return from != DirectLight::hits_only && from != DirectLight::rare_hits_only;
}
/// Where rays meet lights that samples could have found.
constexpr bool leaves_shared_hits_out(DirectLight from) {
  return from == DirectLight::samples_only || from == DirectLight::rare_hits_only;
}

/// `max_depth` counts path edges, -1 is unlimited.
struct PathSettings {
  int max_depth = -1;
  int rr_depth = 5;
  bool hide_emitters = false;  ///< camera rays pass lights and show no environment
  DirectLight direct_light = DirectLight::weighted;
  bool indirect_only = false;  ///< beside maps: no light up to the first Lambertian vertex
  /// The environment, behind surfaces that let camera rays go straight on.
  bool shows_behind_straight = !hide_emitters;
};

/// Which paths the path kernel follows: one row a policy type (path_policies.h).
enum class PathPolicy {
  path_tracing,        ///< PathTracing
  gather_pass,         ///< GatherPass<false>
  gather_pass_looks,   ///< GatherPass<true>
  final_gather,        ///< FinalGatherPass<false>
  final_gather_looks,  ///< FinalGatherPass<true>
  beside_caustic_map,  ///< PathsBesideCaustics
  pilot_pass,          ///< PilotPass
  cache_rays           ///< CacheRays
};

/// Paths that begin at Lambertian surfaces as final gathers' bounces do, in columns; arrays may be read a pack past
/// their ends. A path's radiance is of what it meets, for a throughput of 1.
struct BouncesView {
  std::uint32_t count = 0;
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< origin, off the surface
  const float *to_x = nullptr, *to_y = nullptr, *to_z = nullptr;
  const std::uint32_t *key = nullptr, *index = nullptr;  ///< of the sampler
  float* distance = nullptr;                             ///< filled with the ray's, where it meets anything
};

/// A light as a ball: of the same flux to all sides, per area of its disc.
struct LightBall {
  Vec3f center;
  float radius = 0, radiance = 0;
};

/// Lights to search, and within how many of their radii; without them those that rays meet are what is found.
struct LightSearch {
  const LightBall* lights = nullptr;
  std::size_t count = 0;
  float within = 1;
};

struct PathTask;

/// What camera paths do at rough parts of BSDFs on their way to the first Lambertian surface (rough_gather.h).
struct RoughGathers {
  bool by_photons = false;  ///< light that only they bring is not counted otherwise
  PhotonView map{};         ///< the caustic map; without photons none are looked up
  std::int32_t max_edges = 0;
  const SheetTest* tests = nullptr;  ///< of each surface
  const float* radius = nullptr;     ///< of each path
  float narrow_part = 1;
  /// Points with what was found for them, `flux` times f, and the same within `narrow_part` of their radii.
  GatherPoints points{}, narrow{};
  std::size_t room = 0;  ///< for points
  void (*make_room)(PathTask&) = nullptr;
  void* sink = nullptr;  ///< of `make_room`
};

struct PathTask {
  const SceneView* scene = nullptr;
  CameraTask camera;      ///< where paths start, except CacheRays
  BouncesView bounces{};  ///< where CacheRays start
  PathSettings settings;
  PathPolicy policy = PathPolicy::path_tracing;
  LightSearch search{};              ///< of a PilotPass, which gives `radiance` another meaning (light_search.h)
  float* radiance = nullptr;         ///< 3 a path, in the task's order of paths
  std::uint32_t* scratch = nullptr;  ///< PathKernelEntry::scratch words
  GatherPoints points{};             ///< of a GatherQueue with room for one a path, where paths leave them
  GatherPoints caustic_points{};     ///< of final_gather.h, for caustic photons alone: room for two a path, or none
  bool caustics_at_first = true;     ///< whether the first Lambertian vertex leaves one of those
  RoughGathers rough{};
  float near_hit = 0;  ///< of a final gather: hits nearer than this are traced on
  RayCounts counts{};
};

/// Which paths a map holds; together with direct light by next-event estimation they are all of them, each once.
enum class PhotonKind {
  global,   ///< landed on a diffuse surface after at least one diffuse bounce
  caustic,  ///< landed on its first diffuse surface after at least one specular bounce
};

/// Photons as they land, whatever their path.
struct PhotonDeposits {
  static constexpr std::size_t slack = 16;  ///< of a pack
  static constexpr std::size_t capacity = 4096;
  template <class T>
  using Column = T[capacity];
  PhotonColumns<Column> photons{};
  std::uint32_t path[capacity]{};
  std::size_t count = 0;
};

struct PhotonTask {
  const SceneView* scene = nullptr;
  PhotonKind kind = PhotonKind::global;
  SamplerKind sampler = SamplerKind::sobol;
  std::uint32_t seed = 0;            ///< stream_seed of the map
  std::uint32_t first = 0;           ///< sampler index of the first path
  std::uint32_t count = 0;           ///< paths
  float share = 1;                   ///< of the lights' flux that a path carries
  bool aimed = false;                ///< emitted towards specular surfaces only
  int max_edges = -1;                ///< longest light subpath; -1 is unlimited
  std::uint32_t* scratch = nullptr;  ///< PhotonKernelEntry::scratch words
  PhotonDeposits* deposits = nullptr;
  void (*drain)(PhotonTask&) = nullptr;  ///< empties `deposits`: called when they are full and at the end
  void* sink = nullptr;                  ///< of `drain`
  RayCounts counts{};
};

/// Looks photons up, each point within its own radius.
struct GatherTask {
  PhotonView map{};
  std::int32_t max_edges = 0;  ///< of camera and light path together
  GatherPoints points{};
  const std::uint32_t* order = nullptr;  ///< in which points are looked up
  const SheetTest* tests = nullptr;      ///< of each surface; null: none
};

struct PathKernelEntry {
  unsigned lanes;
  std::size_t scratch;  ///< 32-bit words
  void (*trace)(PathTask&);
};
struct PhotonKernelEntry {
  std::size_t scratch;  ///< 32-bit words
  void (*trace)(PhotonTask&);
};
struct GatherKernelEntry {
  void (*gather)(const GatherTask&);
  /// Adds weight x flux / area of the points to the radiance of their paths, 3 values a path.
  void (*add)(const GatherPoints&, float* radiance);
};

/// The kernels of one instruction set.
struct Kernels {
  const char* isa;
  PathKernelEntry path;
  PhotonKernelEntry photon;
  GatherKernelEntry gather;
};

}  // namespace photonproof::inline renderer_kernels
