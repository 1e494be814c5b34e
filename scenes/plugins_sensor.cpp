// Mitsuba 3's perspective sensor with hdrfilm, box filter and independent sampler; defaults are its.
#include <cmath>
#include <numbers>

#include "scenes/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Camera = decltype(SensorDescription::camera);

constexpr std::int64_t kMaxSide = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

struct Film {
  FilmDescription description;
};
struct Sampler {
  int sample_count;
};
struct BoxFilter {};

FovAxis fov_axis_of(Params& params) {
  const std::string axis = params.string("fov_axis", "x");
  if (axis == "x") return FovAxis::x;
  if (axis == "y") return FovAxis::y;
  if (axis == "diagonal") return FovAxis::diagonal;
  if (axis == "smaller") return FovAxis::smaller;
  if (axis == "larger") return FovAxis::larger;
  params.fail("fov_axis", "is " + in_quotes(axis) + ", expected x, y, diagonal, smaller or larger");
}

/// The diagonal field of view of a 36 x 24 mm film behind a lens of this focal length ("50mm", Mitsuba's default).
double diagonal_fov(Params& params) {
  std::string text = params.string("focal_length", "50mm");
  if (text.size() > 2 && text.ends_with("mm")) text.resize(text.size() - 2);
  const auto millimetres = parse_number(text);
  params.expect(millimetres.value && *millimetres.value > 0, "focal_length",
                "is " + in_quotes(params.string("focal_length", "")) + ", expected a positive length such as 50mm");
  return 2 * std::atan(std::hypot(36.0, 24.0) / (2 * *millimetres.value)) * (180 / std::numbers::pi);
}

Camera build_perspective(Params& params) {
  PerspectiveDescription camera;
  params.expect(!(params.has("fov") && params.has("focal_length")), "focal_length",
                "is given beside fov, expected one or the other");
  if (params.has("fov")) {
    camera.fov_degrees = params.number("fov", camera.fov_degrees);
    camera.fov_axis = fov_axis_of(params);
  } else {
    camera.fov_degrees = diagonal_fov(params);
    camera.fov_axis = FovAxis::diagonal;
  }
  const std::string name = params.has("fov") ? "fov" : "focal_length";
  params.expect(camera.fov_degrees > 0 && camera.fov_degrees < 180, name,
                "makes the field of view " + format_number(camera.fov_degrees) +
                    " degrees, expected more than 0 and less than 180");
  camera.near_clip = params.positive("near_clip", camera.near_clip);
  camera.far_clip = params.number("far_clip", camera.far_clip);
  params.expect(
      camera.far_clip > camera.near_clip, "far_clip",
      "is " + format_number(camera.far_clip) + ", expected more than near_clip, " + format_number(camera.near_clip));
  return camera;
}

void expect_word(Params& params, const std::string& name, const std::string& only) {
  const std::string value = params.string(name, only);
  params.expect(value == only, name, "is " + in_quotes(value) + ", expected " + only + ", the only one supported");
}

Film build_film(Params& params) {
  FilmDescription film;
  film.width = static_cast<int>(params.integer("width", film.width, 1, kMaxSide));
  film.height = static_cast<int>(params.integer("height", film.height, 1, kMaxSide));
  params.expect(
      std::int64_t{film.width} * film.height <= kMaxPixels, "width",
      "times height is " + std::to_string(std::int64_t{film.width} * film.height) + " pixels, expected at most 2^28");
  expect_word(params, "pixel_format", "rgb");
  expect_word(params, "component_format", "float32");
  expect_word(params, "file_format", "openexr");
  return {film};
}

BoxFilter build_box(Params&) { return {}; }

Sampler build_independent(Params& params) {
  return {static_cast<int>(params.integer("sample_count", SensorDescription().sample_count, 1, 1 << 30))};
}

const std::vector<Plugin<Camera>>& sensor_table() {
  static const std::vector<Plugin<Camera>> rows = {{"perspective",
                                                    {{"fov", ParamType::number},
                                                     {"fov_axis", ParamType::string},
                                                     {"focal_length", ParamType::string},
                                                     {"near_clip", ParamType::number},
                                                     {"far_clip", ParamType::number},
                                                     {"to_world", ParamType::transform}},
                                                    {"film", "sampler"},
                                                    build_perspective}};
  return rows;
}

const std::vector<Plugin<Film>>& film_table() {
  static const std::vector<Plugin<Film>> rows = {{"hdrfilm",
                                                  {{"width", ParamType::integer},
                                                   {"height", ParamType::integer},
                                                   {"pixel_format", ParamType::string},
                                                   {"component_format", ParamType::string},
                                                   {"file_format", ParamType::string}},
                                                  {"rfilter"},
                                                  build_film}};
  return rows;
}

const std::vector<Plugin<BoxFilter>>& filter_table() {
  static const std::vector<Plugin<BoxFilter>> rows = {{"box", {}, {}, build_box}};
  return rows;
}

const std::vector<Plugin<Sampler>>& sampler_table() {
  static const std::vector<Plugin<Sampler>> rows = {
      {"independent", {{"sample_count", ParamType::integer}}, {}, build_independent}};
  return rows;
}

FilmDescription read_film(const Sources& sources, const Element& sensor) {
  const std::string filter =
      "expected <rfilter type=\"box\"/> (without one Mitsuba's filter is gaussian, not supported)";
  const Element* element = find_nested(sensor, "film");
  if (!element)
    sources.fail(sensor.at,
                 "the sensor has no <film>, expected <film type=\"hdrfilm\"> that names its filter, " + filter);
  const Film film = build_plugin(sources, *element, film_table());
  const Element* rfilter = find_nested(*element, "rfilter");
  if (!rfilter) sources.fail(element->at, "the film names no reconstruction filter, " + filter);
  build_plugin(sources, *rfilter, filter_table());
  return film.description;
}

/// Turns and moves only: a scaled camera would change what near_clip means.
void check_rigid(const Params& params, const Transform& t) {
  constexpr double kTolerance = 1e-3;  // Mitsuba's, on squared lengths
  const Vec3d axes[3] = {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})};
  for (int i = 0; i < 3; ++i) {
    const bool unit = std::abs(length_squared(axes[i]) - 1) <= kTolerance;
    const bool square = std::abs(dot(axes[i], axes[(i + 1) % 3])) <= kTolerance;
    params.expect(unit && square, "to_world", "scales or shears the camera, expected a rotation and a translation");
  }
}

}  // namespace

SensorDescription read_sensor(const Sources& sources, const Element& element) {
  const Plugin<Camera>& plugin = find_plugin(sources, element, sensor_table());
  Params params(sources, element, title_of(sources, element), plugin.params);
  SensorDescription sensor;
  sensor.loc = sources.loc(element.at);
  sensor.id = id_of(element);
  sensor.to_world = params.transform("to_world");
  check_rigid(params, sensor.to_world);
  sensor.camera = plugin.build(params);
  params.finish();
  sensor.film = read_film(sources, element);
  if (const Element* sampler = find_nested(element, "sampler"))
    sensor.sample_count = build_plugin(sources, *sampler, sampler_table()).sample_count;
  return sensor;
}

}  // namespace photonproof::scene_xml
