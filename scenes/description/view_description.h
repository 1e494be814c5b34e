// Sensors, films, filters and samplers as a scene file states them.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/description/meter_description.h"
#include "scenes/description/texture_description.h"

namespace photonproof::inline scenes_description {

enum class FovAxis { x, y, diagonal, smaller, larger };

/// Looks along local +z, +y up, +x left in the image (Mitsuba's). Rays start on the plane z = near_clip.
struct PerspectiveDescription {
  double fov_degrees = 50;  ///< full angle, along `fov_axis`; the parser converts `focal_length`
  FovAxis fov_axis = FovAxis::x;
  double near_clip = 1e-2;
  double far_clip = 1e4;
  double principal_x = 0,
         principal_y = 0;  ///< offset of the principal point, fractions share of the film's width and height
  friend bool operator==(const PerspectiveDescription&, const PerspectiveDescription&) = default;
};

template <class P, class Camera>
void describe_clips(P& p, Camera& d) {
  p.positive("near_clip", d.near_clip, "rays start at this z");
  p.number("far_clip", d.far_clip, scene_xml::kAny, "above `near_clip`: rays end at this z");
}

template <class P>
void describe_field_of_view(P& p, double& degrees, FovAxis& axis) {
  p.field_of_view(degrees, axis, [&] {
    p.choice("fov_axis", axis,
             {{"x", FovAxis::x},
              {"y", FovAxis::y},
              {"diagonal", FovAxis::diagonal},
              {"smaller", FovAxis::smaller},
              {"larger", FovAxis::larger}},
             "the axis of `fov`");
  });
}

template <class P>
void describe_lens(P& p, PerspectiveDescription& d) {
  describe_field_of_view(p, d.fov_degrees, d.fov_axis);
  p.number("principal_point_offset_x", d.principal_x, scene_xml::kAny, "share of the film's width");
  p.number("principal_point_offset_y", d.principal_y, scene_xml::kAny, "share of the film's height");
  describe_clips(p, d);
}

template <class P>
void describe_placed_camera(P& p, const char* to_world) {
  p.also("to_world", scene_xml::ParamType::transform, "", to_world);
  p.also("shutter_open", scene_xml::ParamType::number, "0", "nothing moves: without effect");
  p.also("shutter_close", scene_xml::ParamType::number, "0", "at least `shutter_open`: without effect");
  p.nested("film", 1, "a film");
  p.nested("sampler", 1, "a sampler");
  p.nested("medium", 1, "the medium around the camera");
}

template <class P>
void describe(P& p, PerspectiveDescription& d) {
  p.plugin("perspective", "along local +z, +y up, +x left in the image");
  describe_lens(p, d);
  describe_placed_camera(p, "turns and moves");
}

/// The perspective camera through a lens of this radius, focused at this distance along local +z.
struct ThinLensDescription {
  PerspectiveDescription perspective;
  double aperture_radius = 0;
  double focus_distance = 1;
  friend bool operator==(const ThinLensDescription&, const ThinLensDescription&) = default;
};

template <class P>
void describe(P& p, ThinLensDescription& d) {
  p.plugin("thinlens", "the perspective camera through a lens");
  describe_lens(p, d.perspective);
  p.require("aperture_radius", "the radius of the lens");
  p.number("aperture_radius", d.aperture_radius, scene_xml::kNotNegative, "scene units");
  p.number_after("focus_distance", d.focus_distance, d.perspective.far_clip, "`far_clip`", "sharp at this z");
  describe_placed_camera(p, "turns and moves");
}

/// Parallel rays along local +z; the film's width spans local x in [-1,1], which to_world may scale.
struct OrthographicDescription {
  double near_clip = 1e-2;
  double far_clip = 1e4;
  friend bool operator==(const OrthographicDescription&, const OrthographicDescription&) = default;
};

template <class P>
void describe(P& p, OrthographicDescription& d) {
  p.plugin("orthographic", "parallel rays along local +z from x in [-1,1]");
  describe_clips(p, d);
  describe_placed_camera(p, "turns, moves and scales");
}

/// Extension: equidistant fisheye. The angle from local +z is proportional to the distance from the image's middle;
/// `fov_degrees` is the full angle across the shorter side. Beyond the circle of that angle pixels are black.
struct FisheyeDescription {
  double fov_degrees = 180;
  double near_clip = 1e-2;
  double far_clip = 1e4;
  friend bool operator==(const FisheyeDescription&, const FisheyeDescription&) = default;
};

template <class P>
void describe(P& p, FisheyeDescription& d) {
  p.plugin("fisheye", "extension: equidistant");
  p.number("fov", d.fov_degrees, {0, 360, "more than 0 and at most 360 degrees", true}, "across the shorter side");
  describe_clips(p, d);
  describe_placed_camera(p, "turns and moves");
}

/// One picture of a batch.
struct BatchView {
  std::variant<PerspectiveDescription, ThinLensDescription, OrthographicDescription, FisheyeDescription> camera;
  Transform to_world;
  friend bool operator==(const BatchView&, const BatchView&) = default;
};

/// Cameras side by side on one film, from left to right, each on as many of its columns.
struct BatchDescription {
  static constexpr std::size_t most_views = 64;
  std::vector<BatchView> views;
  friend bool operator==(const BatchDescription&, const BatchDescription&) = default;
};

template <class P>
void describe(P& p, BatchDescription&) {
  p.plugin("batch", "cameras side by side on one film; not in scenes with media, nor for `bdpt` and `ptracer`");
  p.nested("sensor", BatchDescription::most_views, "cameras of the other kinds, whose films and samplers do not count");
  p.nested("film", 1, "a film, whose width is a multiple of the number of cameras");
  p.nested("sampler", 1, "a sampler");
}

/// Sizes in pixels. Box: radius 0.5. Tent: radius 1. Gaussian: this deviation, cut at 4 deviations and shifted to 0
/// there. The others have negative lobes.
struct ReconstructionFilter {
  enum class Kind { box, tent, gaussian, mitchell, catmullrom, lanczos, sinc };
  Kind kind = Kind::gaussian;
  double stddev = 0.5;
  double radius = 1;                           ///< of the tent
  double b = 1.0 / 3, c = 1.0 / 3;             ///< of mitchell; catmullrom is that of B = 0 and C = 1/2
  std::optional<double> mitchell_radius = {};  ///< without one: 2
  int lobes = 3;                               ///< of lanczos: sinc with this radius and tau
  double sinc_radius = 4, tau = 3;             ///< sinc(x) sinc(x / tau) up to the radius
  friend bool operator==(const ReconstructionFilter&, const ReconstructionFilter&) = default;
};

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
    case ReconstructionFilter::Kind::mitchell:
      p.plugin("mitchell", "cubic, with negative lobes");
      p.number("B", d.b, scene_xml::kShare, "");
      p.number("C", d.c, scene_xml::kShare, "");
      return p.optional_number("radius", d.mitchell_radius, scene_xml::kFilterRadius,
                               "extension: the cubic stretched from 2 pixels to this");
    case ReconstructionFilter::Kind::catmullrom:
      return p.plugin("catmullrom", "mitchell of B = 0 and C = 1/2");
    case ReconstructionFilter::Kind::lanczos:
      p.plugin("lanczos", "sinc(x) sinc(x / lobes), with negative lobes");
      return p.integer("lobes", d.lobes, 1, 16, "radius in pixels");
    case ReconstructionFilter::Kind::sinc:
      p.plugin("sinc", "extension: sinc(x) sinc(x / tau), parameters of pbrt");
      p.number("radius", d.sinc_radius, scene_xml::kFilterRadius, "pixels");
      return p.number("tau", d.tau, {1, 1000, "1 to 1000"}, "");
  }
}

struct FilmDescription {
  int width = 768;
  int height = 576;
  ReconstructionFilter filter = {.kind = ReconstructionFilter::Kind::box};
  /// The rendered part of the image: {x, y, width, height}; empty: the whole image.
  struct Crop {
    int x = 0, y = 0, width = 0, height = 0;
    friend bool operator==(const Crop&, const Crop&) = default;
  };
  std::optional<Crop> crop = {};
  bool sample_border = false;  ///< the filter uses samples beyond the film's border; else only those within
  bool alpha = false;          ///< channel A is written
  Crop window() const { return crop.value_or(Crop{0, 0, width, height}); }
  /// The same part of a film of another size: the borders of the crop are rounded to whole pixels.
  void resize(int new_width, int new_height);
  friend bool operator==(const FilmDescription&, const FilmDescription&) = default;
};

template <class P>
void describe(P& p, FilmDescription& d) {
  p.plugin("hdrfilm", "");
  p.integer("width", d.width, 1, 65536, "pixels; at most 2^28 in all");
  p.integer("height", d.height, 1, 65536, "pixels");
  p.crop(d);
  p.boolean("sample_border", d.sample_border, "wide filters see beyond the border of the film");
  p.choice("pixel_format", d.alpha, {{"rgb", false}, {"rgba", true}}, "`rgba`: A is the share of samples on a shape");
  p.word("component_format", {"float32", "float16"}, true, "always written as float32");
  p.word("file_format", {"openexr", "exr"}, false, "always written as that");
  p.nested("rfilter", 1, "a filter");
}

struct SensorDescription {
  SourceLoc loc;
  std::string id;
  std::variant<PerspectiveDescription, ThinLensDescription, OrthographicDescription, FisheyeDescription,
               RadianceMeterDescription, IrradianceMeterDescription, DistantDescription, BatchDescription>
      camera;
  Transform to_world;
  FilmDescription film;
  int sample_count = 4;
  std::optional<MediumIndex> medium;  ///< around the camera
};

/// All are the renderer's own sampler. The names differ in how samples are spread, not in their mean.
struct SamplerPlugin {
  const char* type = "independent";
  int sample_count = SensorDescription().sample_count;
};

template <class P>
void describe(P& p, SamplerPlugin& d) {
  p.plugin(d.type, "the renderer's own");
  p.integer("sample_count", d.sample_count, 1, 1 << 30, "a pixel");
}

}  // namespace photonproof::inline scenes_description
