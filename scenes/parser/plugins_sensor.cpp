// Mitsuba 3's sensors and samplers, and the extension fisheye; defaults are Mitsuba's.
#include <cmath>

#include "scenes/description/description.h"
#include "scenes/description/overloaded.h"
#include "scenes/description/sensors.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Camera = decltype(SensorDescription::camera);
using SingleCamera = decltype(BatchView::camera);

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

double far_clip_of(const SingleCamera& camera) {
  return std::visit(Overloaded{[](const ThinLensDescription& lens) { return lens.perspective.far_clip; },
                               [](const auto& other) { return other.far_clip; }},
                    camera);
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
  void operator()(RadianceMeterDescription&) const {
    for (const char* name : {"origin", "direction"}) expect_alone(params, "to_world", name);
    if (params.has("origin") != params.has("direction"))
      params.fail(params.has("origin") ? "origin" : "direction", "is alone, expected origin and direction");
    check_rigid(params, params.transform("to_world"));
  }
  void operator()(IrradianceMeterDescription&) const {}
  void operator()(DistantDescription& d) const {
    expect_alone(params, "to_world", "direction");
    check_rigid(params, params.transform("to_world"));
    if (params.has("target")) d.target = params.point("target", {0, 0, 0});
    if (params.nested("shape").empty()) return;
    params.expect(!params.has("target"), "target", "is given beside a shape, expected one or the other");
    d.target = read_target(params.objects().target(params.only_nested("shape")));
  }
  void operator()(BatchDescription& d) const {
    static const std::vector<Plugin<SingleCamera>> cameras = described_plugins<SingleCamera, CompleteSensor>();
    for (const Element* element : params.nested("sensor"))
      d.views.push_back(read_view(params.objects().target(*element), cameras));
    if (d.views.empty())
      params.sources().fail(params.object().at, params.title() + " is empty, expected at least one <sensor>");
  }
  void operator()(SamplerPlugin&) const {}

 private:
  TargetArea read_target(const Element& element) const {
    const ShapeDescription shape = read_shape(params.objects(), element);
    const bool is_disk = std::holds_alternative<DiskDescription>(shape.geometry);
    if (!is_disk && !std::holds_alternative<RectangleDescription>(shape.geometry))
      params.sources().fail(element.at, "the target of " + params.title() + " is no rectangle or disk");
    return {is_disk, shape.to_world};
  }
  BatchView read_view(const Element& element, const std::vector<Plugin<SingleCamera>>& cameras) const {
    const Plugin<SingleCamera>& plugin = find_plugin(params.sources(), element, cameras);
    Params own(params.objects(), element, title_of(params.sources(), element), plugin.params, plugin.nested);
    BatchView view;
    view.to_world = own.transform("to_world");
    view.camera = plugin.build(own);
    for (const char* shutter : {"shutter_open", "shutter_close"}) own.number(shutter, 0);
    own.finish();
    own.expect(far_clip_of(view.camera) == PerspectiveDescription{}.far_clip, "far_clip",
               "is not done in a batch, expected " + format_number(PerspectiveDescription{}.far_clip));
    return view;
  }
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

namespace {

/// Along `direction`, from `origin`, as Mitsuba builds it from these parameters.
Transform along(const Vec3d& origin, const Vec3d& direction) {
  const Vec3d up = std::abs(direction.x) > std::abs(direction.y) ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  return Transform::look_at(origin, origin + direction, up);
}

void place_meter(Params& params, SensorDescription& sensor) {
  if (!params.has("direction")) return;
  const Vec3d origin = params.has("origin") ? params.point("origin", {0, 0, 0}) : Vec3d{0, 0, 0};
  sensor.to_world = along(origin, unit_vector(params, "direction", {0, 0, 1}));
}

void check_film(const Sources& sources, const Element& element, SensorDescription& sensor) {
  const std::string problem = film_problem(sensor);
  if (!problem.empty()) sources.fail(element.at, title_of(sources, element) + " " + problem);
  if (!is_meter(sensor)) return;
  // Every filter of one pixel has the same mean.
  sensor.film.filter = {.kind = ReconstructionFilter::Kind::box};
  sensor.film.sample_border = false;
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
  place_meter(params, sensor);
  params.finish();
  sensor.film.filter = {ReconstructionFilter::Kind::gaussian};
  if (!params.nested("film").empty()) sensor.film = read_film(objects, objects.target(params.only_nested("film")));
  check_film(sources, element, sensor);
  if (!params.nested("sampler").empty())
    sensor.sample_count = build_plugin(objects, objects.target(params.only_nested("sampler")), samplers).sample_count;
  if (!params.nested("medium").empty()) sensor.medium = objects.medium(params.only_nested("medium"));
  return sensor;
}

}  // namespace photonproof::scene_xml
