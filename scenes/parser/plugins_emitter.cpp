// Mitsuba 3's emitters and the extension ies; defaults are Mitsuba's.
#include <cmath>

#include "scenes/description/sun_position.h"
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Light = decltype(EmitterDescription::light);

/// The transform, which must have an inverse.
Transform placed(Params& params) {
  const Transform to_world = params.transform("to_world");
  params.expect(to_world.inverse().has_value(), "to_world", "is singular: it flattens the light");
  return to_world;
}

void expect_alone(Params& params, const std::string& name, const std::string& other) {
  params.expect(!(params.has(name) && params.has(other)), name,
                "is given beside " + other + ", expected one or the other");
}

/// A direction of length 1; one that is so already stays as it is, that writing and reading does not wear it down.
Vec3d unit_vector(Params& params, const std::string& name, const Vec3d& fallback) {
  const Vec3d v = params.point(name, fallback);
  if (std::abs(length_squared(v) - 1) < 1e-8) return v;
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  params.expect(largest > 0, name, "is zero, expected a direction");
  return normalize(v / largest);
}

Colour build_area(Params& params) { return params.colour_map("radiance", RgbD(1.0), 0, kUnbounded); }

Light build_point(Params& params) {
  PointLightDescription light;
  light.intensity = params.colour("intensity", light.intensity, 0, kUnbounded);
  expect_alone(params, "position", "to_world");
  light.position =
      params.has("to_world") ? params.transform("to_world").point({0, 0, 0}) : params.point("position", light.position);
  return light;
}

Light build_spot(Params& params) {
  SpotLightDescription light;
  light.to_world = params.transform("to_world");
  expect_similarity(params, "the light");
  light.intensity = params.colour("intensity", light.intensity, 0, kUnbounded);
  light.cutoff_degrees = params.number("cutoff_angle", light.cutoff_degrees);
  params.expect(light.cutoff_degrees > 0 && light.cutoff_degrees < 90, "cutoff_angle",
                "is " + format_number(light.cutoff_degrees) + ", expected more than 0 and less than 90 degrees");
  light.beam_degrees = params.number("beam_width", light.cutoff_degrees * 3 / 4);
  params.expect(light.beam_degrees >= 0 && light.beam_degrees <= light.cutoff_degrees, "beam_width",
                "is " + format_number(light.beam_degrees) + ", expected from 0 to cutoff_angle, " +
                    format_number(light.cutoff_degrees));
  light.texture = params.texture("texture");
  return light;
}

Light build_directional(Params& params) {
  DirectionalLightDescription light;
  light.irradiance = params.colour("irradiance", light.irradiance, 0, kUnbounded);
  expect_alone(params, "direction", "to_world");
  light.direction = params.has("to_world") ? normalize(placed(params).vector({0, 0, 1}))
                                           : unit_vector(params, "direction", light.direction);
  return light;
}

Light build_constant(Params& params) {
  return ConstantLightDescription{params.colour("radiance", RgbD(1.0), 0, kUnbounded)};
}

Light build_envmap(Params& params) {
  EnvmapDescription light;
  params.expect(params.has("filename"), "filename", "is missing, expected the name of an image");
  params.string("filename", "");
  light.scale = params.number_in("scale", light.scale, 0, kUnbounded);
  light.to_world = params.transform("to_world");
  params.expect(is_even(light.to_world), "to_world", "scales unevenly or shears the map, expected a uniform scale");
  const auto loaded = params.objects().files().image(params.value_of("filename"), false);
  light.filename = loaded.name;
  light.image = loaded.content;
  return light;
}

/// To multiples of 2^-30, so that the way to world space and back, which writing and reading goes, changes nothing.
Vec3d rounded(const Vec3d& v) {
  constexpr double kUnit = 1 << 30;
  return {std::round(v.x * kUnit) / kUnit, std::round(v.y * kUnit) / kUnit, std::round(v.z * kUnit) / kUnit};
}

/// Towards the sun, in the local space of the sky.
Vec3d sun_direction_of(Params& params, const Transform& to_world) {
  const char* const kPlaceAndTime[] = {"latitude", "longitude", "timezone", "year",  "month",
                                       "day",      "hour",      "minute",   "second"};
  if (params.has("sun_direction")) {
    for (const char* name : kPlaceAndTime) expect_alone(params, name, "sun_direction");
    return rounded(to_world.inverse()->vector(unit_vector(params, "sun_direction", {0, 0, 1})) *
                   to_world.similarity_scale());
  }
  PlaceAndTime when;
  when.latitude_degrees = params.number_in("latitude", when.latitude_degrees, -90, 90);
  when.longitude_degrees = params.number_in("longitude", when.longitude_degrees, -180, 180);
  when.timezone_hours = params.number_in("timezone", when.timezone_hours, -24, 24);
  when.year = static_cast<int>(params.integer("year", when.year, 1, 9999));
  when.month = static_cast<int>(params.integer("month", when.month, 1, 12));
  when.day = static_cast<int>(params.integer("day", when.day, 1, 31));
  when.hour = params.number_in("hour", when.hour, 0, 24);
  when.minute = params.number_in("minute", when.minute, 0, 60);
  when.second = params.number_in("second", when.second, 0, 60);
  return rounded(sun_direction(when));
}

Light build_sun_sky(Params& params) {
  SunSkyDescription light;
  light.to_world = params.transform("to_world");
  expect_similarity(params, "the sky");
  light.turbidity = params.number_in("turbidity", light.turbidity, 1, 10);
  light.albedo = params.colour("albedo", light.albedo, 0, 1);
  light.sun_scale = params.number_in("sun_scale", light.sun_scale, 0, kUnbounded);
  light.sky_scale = params.number_in("sky_scale", light.sky_scale, 0, kUnbounded);
  light.sun_aperture_degrees = params.number("sun_aperture", light.sun_aperture_degrees);
  params.expect(light.sun_aperture_degrees > 0 && light.sun_aperture_degrees < 90, "sun_aperture",
                "is " + format_number(light.sun_aperture_degrees) + ", expected more than 0 and less than 90 degrees");
  light.sun_direction = sun_direction_of(params, light.to_world);
  return light;
}

Light build_ies(Params& params) {
  IesLightDescription light;
  params.expect(params.has("filename"), "filename", "is missing, expected the name of an IES file");
  params.string("filename", "");
  light.intensity = params.colour("intensity", light.intensity, 0, kUnbounded);
  light.to_world = params.transform("to_world");
  expect_similarity(params, "the light");
  const auto loaded = params.objects().files().ies(params.value_of("filename"));
  light.filename = loaded.name;
  light.profile = loaded.content;
  return light;
}

const std::vector<Plugin<Colour>>& shape_table() {
  static const std::vector<Plugin<Colour>> rows = {{"area", {{"radiance", ParamType::emission_map}}, {}, build_area}};
  return rows;
}

const std::vector<Plugin<Light>>& scene_table() {
  const ParamSpec to_world{"to_world", ParamType::transform}, filename{"filename", ParamType::string},
      intensity{"intensity", ParamType::emission};
  static const std::vector<Plugin<Light>> rows = {
      {"constant", {{"radiance", ParamType::emission}}, {}, build_constant},
      {"directional",
       {{"direction", ParamType::point}, to_world, {"irradiance", ParamType::emission}},
       {},
       build_directional},
      {"envmap", {filename, {"scale", ParamType::number}, to_world}, {}, build_envmap},
      {"ies", {filename, intensity, to_world}, {}, build_ies},
      {"point", {{"position", ParamType::point}, to_world, intensity}, {}, build_point},
      {"spot",
       {intensity,
        {"cutoff_angle", ParamType::number},
        {"beam_width", ParamType::number},
        {"texture", ParamType::texture},
        to_world},
       {},
       build_spot},
      {"sunsky",
       {{"turbidity", ParamType::number},
        {"albedo", ParamType::colour},
        {"latitude", ParamType::number},
        {"longitude", ParamType::number},
        {"timezone", ParamType::number},
        {"year", ParamType::integer},
        {"month", ParamType::integer},
        {"day", ParamType::integer},
        {"hour", ParamType::number},
        {"minute", ParamType::number},
        {"second", ParamType::number},
        {"sun_direction", ParamType::point},
        {"sun_scale", ParamType::number},
        {"sky_scale", ParamType::number},
        {"sun_aperture", ParamType::number},
        to_world},
       {},
       build_sun_sky},
  };
  return rows;
}

bool has_type(const Element& element, const std::string& type) {
  const Attribute* given = element.find("type");
  return given && given->value == type;
}

}  // namespace

Colour read_area_emitter(SceneObjects& objects, const Element& element) {
  for (const auto& row : scene_table())
    if (has_type(element, row.type))
      objects.sources().fail(element.find("type")->at,
                             "emitter '" + row.type + "' cannot stand in a shape, expected it directly in <scene>");
  return build_plugin(objects, element, shape_table());
}

EmitterDescription read_emitter(SceneObjects& objects, const Element& element) {
  if (has_type(element, "area"))
    objects.sources().fail(element.find("type")->at, "emitter 'area' needs a surface, expected it inside a <shape>");
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, scene_table())};
}

}  // namespace photonproof::scene_xml
