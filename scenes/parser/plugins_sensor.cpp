// Mitsuba 3's perspective, thinlens and orthographic sensors and its samplers, and the extension fisheye; defaults are
// Mitsuba's.
#include <cmath>

#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Camera = decltype(SensorDescription::camera);

/// Allows only turns and moves: a scaled camera would change the meaning of near_clip.
void check_rigid(const Params& params, const Transform& t) {
  constexpr double kTolerance = 1e-3;  // Mitsuba's, on squared lengths
  const Vec3d axes[3] = {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})};
  for (int i = 0; i < 3; ++i) {
    const bool unit = std::abs(length_squared(axes[i]) - 1) <= kTolerance;
    const bool square = std::abs(dot(axes[i], axes[(i + 1) % 3])) <= kTolerance;
    params.expect(unit && square, "to_world", "scales or shears the camera, expected a rotation and a translation");
  }
}

struct CompleteSensor {
  Params& params;

  void operator()(PerspectiveDescription& d) const {
    check_clips(d);
    check_rigid(params, params.transform("to_world"));
  }
  void operator()(ThinLensDescription& d) const {
    (*this)(d.perspective);
    params.positive("focus_distance", d.focus_distance);
  }
  void operator()(OrthographicDescription& d) const {
    check_clips(d);
    const Transform t = params.transform("to_world");
    params.expect(t.inverse().has_value(), "to_world", "is singular: it flattens the image");
    const Vec3d x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
    params.expect(is_perpendicular(x, y) && is_perpendicular(y, z) && is_perpendicular(z, x), "to_world",
                  "shears the camera, expected rotations, translations and scales");
  }
  void operator()(FisheyeDescription& d) const {
    check_clips(d);
    check_rigid(params, params.transform("to_world"));
  }
  void operator()(SamplerPlugin&) const {}

 private:
  template <class Any>
  void check_clips(const Any& camera) const {
    params.expect(
        camera.far_clip > camera.near_clip, "far_clip",
        "is " + format_number(camera.far_clip) + ", expected more than near_clip, " + format_number(camera.near_clip));
  }
};

std::vector<Plugin<SamplerPlugin>> sampler_table() {
  std::vector<Plugin<SamplerPlugin>> rows;
  for (const char* type : {"independent", "ldsampler", "multijitter", "orthogonal", "stratified"})
    rows.push_back(described_plugin<SamplerPlugin, CompleteSensor>(SamplerPlugin{type}));
  return rows;
}

}  // namespace

SensorDescription read_sensor(SceneObjects& objects, const Element& element) {
  const Sources& sources = objects.sources();
  static const std::vector<Plugin<Camera>> cameras = described_plugins<Camera, CompleteSensor>();
  static const std::vector<Plugin<SamplerPlugin>> samplers = sampler_table();
  const Plugin<Camera>& plugin = find_plugin(sources, element, cameras);
  Params params(objects, element, title_of(sources, element), plugin.params, plugin.nested);
  SensorDescription sensor;
  sensor.loc = sources.loc(element.at);
  sensor.id = id_of(element);
  sensor.to_world = params.transform("to_world");
  sensor.camera = plugin.build(params);
  params.expect(params.number("shutter_open", 0) <= params.number("shutter_close", 0), "shutter_open",
                "is after shutter_close");
  params.finish();
  sensor.film.filter = {ReconstructionFilter::Kind::gaussian};
  if (!params.nested("film").empty()) sensor.film = read_film(objects, objects.target(params.only_nested("film")));
  if (!params.nested("sampler").empty())
    sensor.sample_count = build_plugin(objects, objects.target(params.only_nested("sampler")), samplers).sample_count;
  if (!params.nested("medium").empty()) sensor.medium = objects.medium(params.only_nested("medium"));
  return sensor;
}

}  // namespace photonproof::scene_xml
