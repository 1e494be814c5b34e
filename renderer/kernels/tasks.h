// Tasks of the kernels, and the table of the kernels for one instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/ray_counts.h"
#include "renderer/kernels/gather_points.h"
#include "renderer/lanes/sampler.h"
#include "renderer/photons/photon_view.h"
#include "renderer/scene/scene_view.h"

namespace photonproof::inline renderer_kernels {

/// Camera samples [first_sample, first_sample + samples) of every pixel of a tile, or of some; at most 2^20 in all.
struct CameraTask {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::uint32_t first_sample = 0, samples = 0;
  std::uint32_t seed = 0;  ///< stream_seed of the camera
  SamplerKind sampler = SamplerKind::sobol;
  int grid = 0;                                ///< k > 0: samples on the centres of a k x k grid in the pixel
  const std::uint32_t* some_pixels = nullptr;  ///< of the tile, row by row; null: all of them
  std::uint32_t some_count = 0;
  FilterPart part = FilterPart::positive;  ///< of a filter with negative lobes

  std::uint32_t tile_width() const { return static_cast<std::uint32_t>(x1 - x0); }
  std::uint32_t pixels() const {
    return some_pixels != nullptr ? some_count : tile_width() * static_cast<std::uint32_t>(y1 - y0);
  }
  std::uint32_t pixel(std::uint32_t nth) const { return some_pixels != nullptr ? some_pixels[nth] : nth; }
  std::uint32_t paths() const { return pixels() * samples; }
};

/// How direct light at the vertices of a path is estimated.
enum class DirectLight {
  weighted,       ///< Light samples and rays that meet lights, by multiple importance sampling.
  unweighted,     ///< Both, where no light can be found both ways.
  samples_only,   ///< Light samples; rays count only lights that samples cannot find.
  hits_only,      ///< Rays that meet lights, without samples.
  rare_hits_only  ///< Rays count only lights that samples could not find; no samples either.
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

/// The paths that the path kernel follows: one row per policy type (path_policies.h).
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

/// Paths that begin at Lambertian surfaces as final gathers' bounces do, in columns. Arrays may be read one pack past
/// their ends. A path's radiance is that of the surfaces it meets, for a throughput of 1.
struct BouncesView {
  std::uint32_t count = 0;
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< origin, off the surface
  const float *to_x = nullptr, *to_y = nullptr, *to_z = nullptr;
  const std::uint32_t *key = nullptr, *index = nullptr;  ///< of the sampler
  float* distance = nullptr;                             ///< receives the ray's length, where it meets a surface
};

/// A light as a ball with equal flux in all directions, per area of its disc.
struct LightBall {
  Vec3f center;
  float radius = 0, radiance = 0;
};

/// Lights to search, and within how many of their radii. Without any, the search finds the lights that rays meet.
struct LightSearch {
  const LightBall* lights = nullptr;
  std::size_t count = 0;
  float within = 1;
};

struct PathTask;

/// Gathering by camera paths at rough parts of BSDFs, before the first Lambertian surface (rough_gather.h).
struct RoughGathers {
  bool by_photons = false;  ///< light that only photons add is not counted otherwise
  PhotonView map{};         ///< the caustic map; without photons nothing is gathered
  std::int32_t max_edges = 0;
  const SheetTest* tests = nullptr;  ///< of each surface
  const float* radius = nullptr;     ///< of each path
  float narrow_part = 1;
  /// Points with their gathered photons, `flux` times f, and the same within `narrow_part` of their radii.
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
  LightSearch search{};              ///< For a PilotPass, which gives `radiance` another meaning (light_search.h).
  float* radiance = nullptr;         ///< 3 values per path, in the task's order of paths.
  std::uint32_t* scratch = nullptr;  ///< PathKernelEntry::scratch words.
  GatherPoints points{};             ///< A GatherQueue's, with room for one per path, where paths leave some.
  GatherPoints caustic_points{};     ///< For caustic photons alone (final_gather.h). Room for two per path, or none.
  bool caustics_at_first = true;     ///< Whether the first Lambertian vertex leaves one of those.
  RoughGathers rough{};
  float near_hit = 0;  ///< final gather: hits nearer than this are traced on
  RayCounts counts{};
};

/// The paths that a map holds. Together with direct light by next-event estimation they are all paths, each once.
enum class PhotonKind {
  global,   ///< landed on a diffuse surface after at least one diffuse bounce
  caustic,  ///< landed on its first diffuse surface after at least one specular bounce
};

/// Photons as they land, for paths of any kind.
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
  std::uint32_t seed = 0;            ///< The map's stream_seed.
  std::uint32_t first = 0;           ///< Sampler index of the first path.
  std::uint32_t count = 0;           ///< Number of paths.
  float share = 1;                   ///< Share of the lights' flux that a path carries.
  bool aimed = false;                ///< Emitted towards specular surfaces only.
  int max_edges = -1;                ///< Longest light subpath; -1 is unlimited.
  std::uint32_t* scratch = nullptr;  ///< PhotonKernelEntry::scratch words.
  PhotonDeposits* deposits = nullptr;
  void (*drain)(PhotonTask&) = nullptr;  ///< empties `deposits`: called when they are full and at the end
  void* sink = nullptr;                  ///< of `drain`
  RayCounts counts{};
};

/// Gathers photons, for each point within its own radius.
struct GatherTask {
  PhotonView map{};
  std::int32_t max_edges = 0;  ///< edges of camera and light path together
  GatherPoints points{};
  const std::uint32_t* order = nullptr;  ///< the order in which points are processed
  const SheetTest* tests = nullptr;      ///< one per surface; null: none
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
  /// Adds weight x flux / area of the points to the radiance of their paths, 3 values per path.
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
