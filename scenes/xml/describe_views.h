// Sensors, films, filters, samplers and integrators as a scene file has them (describe_bsdfs.h says how).
#pragma once

#include "scenes/description/description.h"
#include "scenes/xml/param_type.h"

namespace photonproof {

template <class P>
void describe_placed_camera(P& p, const char* to_world) {
  p.also("to_world", scene_xml::ParamType::transform, "", to_world);
  p.nested("film", 1, "a film");
  p.nested("sampler", 1, "a sampler");
  p.nested("medium", 1, "the medium around the camera");
}

template <class P, class Camera>
void describe_clips(P& p, Camera& d) {
  p.positive("near_clip", d.near_clip, "rays start at this z");
  p.number("far_clip", d.far_clip, scene_xml::kAny, "above `near_clip`: rays end at this z");
}

template <class P>
void describe_lens(P& p, PerspectiveDescription& d) {
  p.field_of_view(d.fov_degrees, d.fov_axis, [&] {
    p.choice("fov_axis", d.fov_axis,
             {{"x", FovAxis::x},
              {"y", FovAxis::y},
              {"diagonal", FovAxis::diagonal},
              {"smaller", FovAxis::smaller},
              {"larger", FovAxis::larger}},
             "what `fov` is along");
  });
  p.number("principal_point_offset_x", d.principal_x, scene_xml::kAny, "of the film's width");
  p.number("principal_point_offset_y", d.principal_y, scene_xml::kAny, "of the film's height");
  describe_clips(p, d);
}

template <class P>
void describe(P& p, PerspectiveDescription& d) {
  p.plugin("perspective", "along local +z, +y up, +x left in the image");
  describe_lens(p, d);
  describe_placed_camera(p, "turns and moves");
}

template <class P>
void describe(P& p, ThinLensDescription& d) {
  p.plugin("thinlens", "the perspective camera through a lens");
  describe_lens(p, d.perspective);
  p.require("aperture_radius", "the radius of the lens");
  p.number("aperture_radius", d.aperture_radius, scene_xml::kNotNegative, "scene units");
  p.number_after("focus_distance", d.focus_distance, d.perspective.far_clip, "`far_clip`", "sharp at this z");
  describe_placed_camera(p, "turns and moves");
}

template <class P>
void describe(P& p, OrthographicDescription& d) {
  p.plugin("orthographic", "parallel rays along local +z from x in [-1,1]");
  describe_clips(p, d);
  describe_placed_camera(p, "turns, moves and scales");
}

template <class P>
void describe(P& p, FisheyeDescription& d) {
  p.plugin("fisheye", "extension: equidistant");
  p.number("fov", d.fov_degrees, {0, 360, "more than 0 and at most 360 degrees", true}, "across the shorter side");
  describe_clips(p, d);
  describe_placed_camera(p, "turns and moves");
}

/// All are the renderer's own sampler: the names differ in how samples are spread, not in what they average to.
struct SamplerPlugin {
  const char* type = "independent";
  int sample_count = SensorDescription().sample_count;
};

template <class P>
void describe(P& p, SamplerPlugin& d) {
  p.plugin(d.type, "the renderer's own");
  p.integer("sample_count", d.sample_count, 1, 1 << 30, "a pixel");
}

template <class P>
void describe(P& p, FilmDescription& d) {
  p.plugin("hdrfilm", "");
  p.integer("width", d.width, 1, 65536, "pixels; at most 2^28 in all");
  p.integer("height", d.height, 1, 65536, "pixels");
  p.crop(d);
  p.word("pixel_format", {"rgb", "rgba"}, false, "always written as rgb");
  p.word("component_format", {"float32", "float16"}, true, "always written as float32");
  p.word("file_format", {"openexr", "exr"}, false, "always written as that");
  p.nested("rfilter", 1, "a filter");
}

template <class P>
void describe(P& p, ReconstructionFilter& d) {
  switch (d.kind) {
    case ReconstructionFilter::Kind::box:
      return p.plugin("box", "radius 0.5 pixels");
    case ReconstructionFilter::Kind::tent:
      p.plugin("tent", "");
      return p.positive("radius", d.radius, "pixels", 16, "pixels");
    case ReconstructionFilter::Kind::gaussian:
      p.plugin("gaussian", "cut at 4 deviations; when none is named");
      return p.positive("stddev", d.stddev, "pixels", 4, "pixels");
  }
}

template <class P>
void describe_limits(P& p, PathLimits& d) {
  p.integer("max_depth", d.max_depth, -1, 1'000'000, "edges of a path, -1 for no end; not 0");
  p.integer("rr_depth", d.rr_depth, 1, 1'000'000, "roulette from this depth on");
  p.boolean("hide_emitters", d.hide_emitters, "the camera does not see lights");
}

template <class P>
void describe(P& p, PathDescription& d) {
  p.plugin("path", "path tracing without media");
  describe_limits(p, d);
}

template <class P>
void describe(P& p, VolPathDescription& d) {
  p.plugin("volpath", "path tracing through media");
  describe_limits(p, d);
}

template <class P>
void describe(P& p, BdptDescription& d) {
  p.plugin("bdpt", "extension: bidirectional path tracing");
  describe_limits(p, d);
}

template <class P>
void describe(P& p, ParticleTracerDescription& d) {
  p.plugin("ptracer", "light tracing");
  describe_limits(p, d);
}

template <class P>
void describe(P& p, WhittedDescription& d) {
  p.plugin("whitted", "extension: Whitted 1980");
  describe_limits(p, d);
}

template <class P>
void describe(P& p, DirectDescription& d) {
  p.plugin("direct", "direct light");
  p.also("shading_samples", scene_xml::ParamType::integer, "1", "in place of the next two, for both");
  p.integer("emitter_samples", d.emitter_samples, 0, 1 << 16, "of lights, a camera sample");
  p.integer("bsdf_samples", d.bsdf_samples, 0, 1 << 16, "of directions, a camera sample; not both 0");
  p.boolean("hide_emitters", d.hide_emitters, "the camera does not see lights");
}

template <class P>
void describe(P& p, PhotonMapperDescription& d) {
  constexpr std::int64_t most = std::int64_t{1} << 40;
  constexpr scene_xml::Range radius{0, scene_xml::kUnbounded, "a positive length, or 0 for the automatic choice"};
  p.plugin("photonmapper", "extension: photon mapping with a global and a caustic map");
  describe_limits(p, d);
  p.integer("global_photons", d.global_photons, 0, most, "emitted for the global map");
  p.integer("caustic_photons", d.caustic_photons, 0, most, "emitted for the caustic map");
  p.number("global_radius", d.global_radius, radius, "of a look-up, scene units");
  p.number("caustic_radius", d.caustic_radius, radius, "of a look-up, scene units");
}

/// Mitsuba's wrapper that adds the variance of every pixel.
struct MomentPlugin {};

template <class P>
void describe(P& p, MomentPlugin&) {
  p.plugin("moment", "the nested integrator: the variance is always written");
  p.nested("integrator", 1, "an integrator");
}

}  // namespace photonproof
