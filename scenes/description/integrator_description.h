// Integrators as a scene file states them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <variant>

#include "scenes/base/input_error.h"
#include "scenes/description/param_type.h"

namespace photonproof::inline scenes_description {

/// Parameters of all integrators. `max_depth` counts path edges as Mitsuba does (1 = emitters only, 2 = direct light);
/// -1 is unlimited. The parser takes the lights from a scene of max_depth 0, which Mitsuba renders black, and says 1.
struct PathLimits {
  int max_depth = -1;
  int rr_depth = 5;  ///< Russian roulette from this depth on
  bool hide_emitters = false;
  friend bool operator==(const PathLimits&, const PathLimits&) = default;
};

/// Path tracing with next-event estimation. It never ignores media: it refuses scenes that have some.
struct PathDescription : PathLimits {
  friend bool operator==(const PathDescription&, const PathDescription&) = default;
};

template <class P>
void describe_limits(P& p, PathLimits& d) {
  p.integer("max_depth", d.max_depth, -1, 1'000'000, "edges of a path, -1 for no end; 0 is black");
  p.integer("rr_depth", d.rr_depth, 1, 1'000'000, "roulette from this depth on");
  p.boolean("hide_emitters", d.hide_emitters, "the camera does not see lights");
}

template <class P>
void describe(P& p, PathDescription& d) {
  p.plugin("path", "path tracing without media");
  describe_limits(p, d);
}

/// Path tracing through participating media and nested dielectrics.
struct VolPathDescription : PathLimits {
  friend bool operator==(const VolPathDescription&, const VolPathDescription&) = default;
};

template <class P>
void describe(P& p, VolPathDescription& d) {
  p.plugin("volpath", "path tracing through media");
  describe_limits(p, d);
}

/// Bidirectional path tracing with multiple importance sampling over all strategies.
struct BdptDescription : PathLimits {
  friend bool operator==(const BdptDescription&, const BdptDescription&) = default;
};

template <class P>
void describe(P& p, BdptDescription& d) {
  p.plugin("bdpt", "extension: bidirectional path tracing");
  describe_limits(p, d);
}

/// Light tracing: paths start at the lights, every vertex is connected to the camera.
struct ParticleTracerDescription : PathLimits {
  friend bool operator==(const ParticleTracerDescription&, const ParticleTracerDescription&) = default;
};

template <class P>
void describe(P& p, ParticleTracerDescription& d) {
  p.plugin("ptracer", "light tracing");
  describe_limits(p, d);
}

/// Direct light only, without max_depth and rr_depth. Each camera sample takes `emitter_samples` and `bsdf_samples`,
/// weighted against each other.
struct DirectDescription : PathLimits {
  int emitter_samples = 1, bsdf_samples = 1;
  friend bool operator==(const DirectDescription&, const DirectDescription&) = default;
};

template <class P>
void describe(P& p, DirectDescription& d) {
  p.plugin("direct", "direct light");
  p.also("shading_samples", scene_xml::ParamType::integer, "1", "in place of the next two, for both");
  p.integer("emitter_samples", d.emitter_samples, 0, 1 << 16, "samples of lights for each camera sample");
  p.integer("bsdf_samples", d.bsdf_samples, 0, 1 << 16, "samples of directions for each camera sample; not both 0");
  p.boolean("hide_emitters", d.hide_emitters, "the camera does not see lights");
}

/// Whitted 1980: both branches at smooth dielectrics, mirrors, direct light everywhere else, and no further light.
struct WhittedDescription : PathLimits {
  friend bool operator==(const WhittedDescription&, const WhittedDescription&) = default;
};

template <class P>
void describe(P& p, WhittedDescription& d) {
  p.plugin("whitted", "extension: Whitted 1980");
  describe_limits(p, d);
}

/// The method for light between diffuse surfaces.
enum class IndirectLight {
  automatic,  ///< Photons or paths, whichever has the smaller error in the same time.
  map,        ///< Photons around the first diffuse surface of the camera path.
  gather,     ///< Photons around the end of one more bounce from there.
  cache,      ///< Interpolation between few points, each of which gathers.
  path        ///< Path tracing, without photons except those of caustics.
};

/// In the order of the enumeration.
inline constexpr std::initializer_list<scene_xml::Word<IndirectLight>> indirect_words{
    {"automatic", IndirectLight::automatic}, {"map", IndirectLight::map},   {"gather", IndirectLight::gather},
    {"cache", IndirectLight::cache},         {"path", IndirectLight::path},
};

inline const char* word_of(IndirectLight indirect) { return indirect_words.begin()[static_cast<int>(indirect)].text; }

/// Photon mapping with a global and a caustic map. 0 stands for the automatic choice.
struct PhotonMapperDescription : PathLimits {
  std::int64_t global_photons = 0;   ///< Emitted for the global map, over the whole render. 0: automatic.
  std::int64_t caustic_photons = 0;  ///< Emitted for the caustic map, over the whole render. 0: automatic.
  double global_radius = 0;          ///< Scene units.
  double caustic_radius = 0;         ///< Scene units.
  IndirectLight indirect = IndirectLight::automatic;
  double cache_error = 0.15;       ///< at the least weight: a record's reach over the distance it sees
  std::int64_t gather_rays = 256;  ///< per record
  friend bool operator==(const PhotonMapperDescription&, const PhotonMapperDescription&) = default;
};

template <class P>
void describe(P& p, PhotonMapperDescription& d) {
  constexpr std::int64_t most = std::int64_t{1} << 40;
  constexpr scene_xml::Range radius{0, scene_xml::kUnbounded, "a positive length, or 0 for the automatic choice"};
  p.plugin("photonmapper", "extension: photon mapping with a global and a caustic map");
  describe_limits(p, d);
  p.integer("global_photons", d.global_photons, 0, most, "emitted for the global map; 0: a quarter of the samples");
  p.integer("caustic_photons", d.caustic_photons, 0, most, "emitted for the caustic map; 0: a quarter of the samples");
  p.number("global_radius", d.global_radius, radius, "radius of a gather, scene units");
  p.number("caustic_radius", d.caustic_radius, radius, "radius of a gather, scene units");
  p.choice("indirect", d.indirect, indirect_words,
           "light between diffuse surfaces, by global photons at the first (map), one bounce further (gather), "
           "interpolated between such points (cache), or by paths; `automatic` asks a pilot");
  p.number("cache_error", d.cache_error, {0, 1, nullptr, true},
           "the largest error of interpolation, by Ward's estimate");
  p.integer("gather_rays", d.gather_rays, 4, 1 << 20, "rays of each point of the cache");
}

/// Stochastic progressive photon mapping (Hachisuka and Jensen 2009; Knaus and Zwicker 2011).
struct SppmDescription : PathLimits {
  std::int64_t photons = 250'000;  ///< per pass, for each map
  double radius = 0;               ///< radius of the first pass, scene units; 0: automatic
  double alpha = 2.0 / 3;          ///< r^2 of pass i + 1 is (i + alpha) / (i + 1) of that of pass i
  friend bool operator==(const SppmDescription&, const SppmDescription&) = default;
};

template <class P>
void describe(P& p, SppmDescription& d) {
  p.plugin("sppm", "extension: stochastic progressive photon mapping");
  describe_limits(p, d);
  p.integer("photons", d.photons, 1, 1'000'000'000, "emitted in every pass, for each map");
  p.number("radius", d.radius, {0, scene_xml::kUnbounded, "a positive length, or 0 for the automatic choice"},
           "radius of the first pass, scene units");
  p.number("alpha", d.alpha, {0, 1, nullptr, true, true}, "share of a disc that passes keep: 1 is all");
}

/// The radiance field of volumetric primitives (Condor et al. 2024; Moenne-Loccoz et al. 2024): ellipsoids along a ray
/// are blended in the order in which it enters them. Lights do not matter, and other surfaces are black.
struct RadianceFieldDescription : PathLimits {
  RadianceFieldDescription() { max_depth = 64; }
  bool srgb_primitives = true;
  friend bool operator==(const RadianceFieldDescription&, const RadianceFieldDescription&) = default;
};

template <class P>
void describe(P& p, RadianceFieldDescription& d) {
  p.plugin("volprim_rf_basic", "ellipsoids with opacities and spherical harmonics, blended in order; no lights");
  p.integer("max_depth", d.max_depth, -1, 1'000'000, "ellipsoids along a ray, -1 for no end");
  p.boolean("srgb_primitives", d.srgb_primitives, "blended colours are sRGB, which the image makes linear");
}

struct IntegratorDescription {
  SourceLoc loc;
  std::variant<PathDescription, PhotonMapperDescription, VolPathDescription, BdptDescription, ParticleTracerDescription,
               DirectDescription, WhittedDescription, SppmDescription, RadianceFieldDescription>
      method;

  const PathLimits& limits() const {
    return std::visit([](const auto& m) -> const PathLimits& { return m; }, method);
  }
};

/// Mitsuba's wrapper that adds the variance of every pixel.
struct MomentPlugin {};

template <class P>
void describe(P& p, MomentPlugin&) {
  p.plugin("moment", "the nested integrator: the variance is always written");
  p.nested("integrator", 1, "an integrator");
}

}  // namespace photonproof::inline scenes_description
