// Mitsuba 3's perspective, thinlens and orthographic sensors and its samplers, and the extension fisheye; defaults are
// Mitsuba's.
#include <cmath>
#include <numbers>

#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Camera = decltype(SensorDescription::camera);

struct Sampler {
  int sample_count;
};

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

template <class Camera>
void read_clips(Params& params, Camera& camera) {
  camera.near_clip = params.positive("near_clip", camera.near_clip);
  camera.far_clip = params.number("far_clip", camera.far_clip);
  params.expect(
      camera.far_clip > camera.near_clip, "far_clip",
      "is " + format_number(camera.far_clip) + ", expected more than near_clip, " + format_number(camera.near_clip));
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

PerspectiveDescription read_perspective(Params& params) {
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
  read_clips(params, camera);
  camera.principal_x = params.number("principal_point_offset_x", 0);
  camera.principal_y = params.number("principal_point_offset_y", 0);
  check_rigid(params, params.transform("to_world"));
  return camera;
}

Camera build_perspective(Params& params) { return read_perspective(params); }

Camera build_thin_lens(Params& params) {
  ThinLensDescription camera;
  camera.perspective = read_perspective(params);
  params.expect(params.has("aperture_radius"), "aperture_radius", "is missing, expected the radius of the lens");
  camera.aperture_radius = params.number_in("aperture_radius", 0, 0, kUnbounded);
  camera.focus_distance = params.positive("focus_distance", camera.perspective.far_clip);
  return camera;
}

Camera build_orthographic(Params& params) {
  OrthographicDescription camera;
  read_clips(params, camera);
  const Transform t = params.transform("to_world");
  params.expect(t.inverse().has_value(), "to_world", "is singular: it flattens the image");
  const Vec3d x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  params.expect(is_perpendicular(x, y) && is_perpendicular(y, z) && is_perpendicular(z, x), "to_world",
                "shears the camera, expected rotations, translations and scales");
  return camera;
}

Camera build_fisheye(Params& params) {
  FisheyeDescription camera;
  camera.fov_degrees = params.number("fov", camera.fov_degrees);
  params.expect(camera.fov_degrees > 0 && camera.fov_degrees <= 360, "fov",
                "is " + format_number(camera.fov_degrees) + ", expected more than 0 and at most 360 degrees");
  read_clips(params, camera);
  check_rigid(params, params.transform("to_world"));
  return camera;
}

Sampler build_sampler(Params& params) {
  return {static_cast<int>(params.integer("sample_count", SensorDescription().sample_count, 1, 1 << 30))};
}

std::vector<ParamSpec> with_common(std::vector<ParamSpec> own) {
  own.push_back({"near_clip", ParamType::number});
  own.push_back({"far_clip", ParamType::number});
  own.push_back({"to_world", ParamType::transform});
  return own;
}

std::vector<ParamSpec> with_lens(std::vector<ParamSpec> own) {
  own.insert(own.begin(), {{"fov", ParamType::number},
                           {"fov_axis", ParamType::string},
                           {"focal_length", ParamType::string},
                           {"principal_point_offset_x", ParamType::number},
                           {"principal_point_offset_y", ParamType::number}});
  return with_common(std::move(own));
}

const std::vector<Plugin<Camera>>& sensor_table() {
  static const std::vector<NestedSpec> inside = {{"film"}, {"sampler"}, {"medium"}};
  static const std::vector<Plugin<Camera>> rows = {
      {"fisheye", with_common({{"fov", ParamType::number}}), inside, build_fisheye},
      {"orthographic", with_common({}), inside, build_orthographic},
      {"perspective", with_lens({}), inside, build_perspective},
      {"thinlens", with_lens({{"aperture_radius", ParamType::number}, {"focus_distance", ParamType::number}}), inside,
       build_thin_lens},
  };
  return rows;
}

/// All are the renderer's own sampler: the names differ in how samples are spread, not in what they average to.
const std::vector<Plugin<Sampler>>& sampler_table() {
  const std::vector<ParamSpec> count = {{"sample_count", ParamType::integer}};
  static const std::vector<Plugin<Sampler>> rows = {{"independent", count, {}, build_sampler},
                                                    {"ldsampler", count, {}, build_sampler},
                                                    {"multijitter", count, {}, build_sampler},
                                                    {"orthogonal", count, {}, build_sampler},
                                                    {"stratified", count, {}, build_sampler}};
  return rows;
}

}  // namespace

SensorDescription read_sensor(SceneObjects& objects, const Element& element) {
  const Sources& sources = objects.sources();
  const Plugin<Camera>& plugin = find_plugin(sources, element, sensor_table());
  Params params(objects, element, title_of(sources, element), plugin.params, plugin.nested);
  SensorDescription sensor;
  sensor.loc = sources.loc(element.at);
  sensor.id = id_of(element);
  sensor.to_world = params.transform("to_world");
  sensor.camera = plugin.build(params);
  params.finish();
  sensor.film.filter = {ReconstructionFilter::Kind::gaussian};
  if (!params.nested("film").empty()) sensor.film = read_film(objects, objects.target(params.only_nested("film")));
  if (!params.nested("sampler").empty())
    sensor.sample_count =
        build_plugin(objects, objects.target(params.only_nested("sampler")), sampler_table()).sample_count;
  if (!params.nested("medium").empty()) sensor.medium = objects.medium(params.only_nested("medium"));
  return sensor;
}

}  // namespace photonproof::scene_xml
