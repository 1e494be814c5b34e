#include "reference/cycles/cycles_lights.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <variant>

#include "reference/cycles/cycles_shaders.h"
#include "reference/cycles/python_text.h"
#include "reference/engines/ies_image.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_cycles {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A place and axes of unit length.
Transform rigid(const Transform& t) {
  const Vec3d x = normalize(t.vector({1, 0, 0})), y = normalize(t.vector({0, 1, 0})),
              z = normalize(t.vector({0, 0, 1}));
  const Vec3d p = t.point({0, 0, 0});
  Transform result;
  result.m = {x.x, y.x, z.x, p.x, x.y, y.y, z.y, p.y, x.z, y.z, z.z, p.z, 0, 0, 0, 1};
  return result;
}

/// Columns of an object whose -z is this direction.
Transform along_minus_z(const Vec3d& direction) {
  const Vec3d z = -normalize(direction);
  const Vec3d helper = std::abs(z.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d x = normalize(cross(helper, z)), y = cross(z, x);
  Transform t;
  t.m = {x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0, 0, 0, 0, 1};
  return t;
}

struct Light {
  CyclesScript& script;
  const EmitterDescription& emitter;
  std::string name;
  bool hidden;  ///< from the camera

  std::string head(const char* function) const { return std::string(function) + "(" + py_string(name) + ", "; }

  void operator()(const PointLightDescription& point) const {
    script.line(head("point_light") + py_tuple(point.position) + ", " + py_tuple(point.intensity) + ")");
  }
  void operator()(const SpotLightDescription& spot) const {
    script.line(head("spot_light") + py_columns(rigid(spot.to_world)) + ", " + py_tuple(spot.intensity) + ", " +
                format_number(spot.cutoff_degrees * kDegree) + ", " + format_number(spot.beam_degrees * kDegree) +
                (spot.texture ? ", lambda g: " + colour_py(script, *spot.texture) + ")" : ")"));
  }
  void operator()(const DirectionalLightDescription& beam) const {
    script.line(head("sun") + py_columns(along_minus_z(beam.direction)) + ", " + py_tuple(beam.irradiance) + ")");
  }
  void operator()(const ConstantLightDescription& sky) const {
    script.line("sky(" + py_tuple(sky.radiance) + (hidden ? ", hidden=True)" : ")"));
  }
  void operator()(const EnvmapDescription& map) const {
    const Transform& t = map.to_world;
    const std::string axes = py_tuple(std::vector<std::string>{py_tuple(normalize(t.vector({1, 0, 0}))),
                                                               py_tuple(normalize(t.vector({0, 1, 0}))),
                                                               py_tuple(normalize(t.vector({0, 0, 1})))});
    script.line("sky(file=" + py_string(script.file_of(map.image)) + ", rows=" + axes +
                ", factor=" + format_number(map.scale) + ", height=" + std::to_string(map.image->height) +
                ", resolution=" + std::to_string(std::clamp(map.image->width, 256, 4096)) +
                (hidden ? ", hidden=True)" : ")"));
  }
  void operator()(const SunSkyDescription&) const {
    script.refuse(emitter.loc,
                  "a sun and its sky: Cycles' sky is of another model; an envmap and a directional light can "
                  "be written");
  }
  void operator()(const ProjectorDescription&) const {
    script.refuse(emitter.loc, "a projector: not written yet; a spot with a texture can be");
  }
  void operator()(const IesLightDescription& light) const {
    const auto image = std::make_shared<const Image>(ies_image(*light.profile));
    script.line(head("ies_light") + py_columns(rigid(light.to_world)) + ", " + py_tuple(light.intensity) + ", " +
                py_string(script.file_of(image)) + ", " + std::to_string(image->width) + ", " +
                std::to_string(image->height) + ")");
  }
};

/// The medium around the camera, unless it is that of a body around it.
void write_fog(CyclesScript& script) {
  const SceneDescription& scene = script.scene();
  if (!scene.sensor.medium) return;
  const bool bounded = std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const ShapeDescription& shape) {
    return shape.interior == scene.sensor.medium;
  });
  if (bounded) return;  // Cycles finds the bodies that its camera is in by itself
  for (const ShapeDescription& shape : scene.shapes)
    if (shape.interior || shape.exterior)
      script.refuse(shape.loc, "a medium where another is: Cycles adds up media that overlap");
  script.explain("the medium around the camera has no border: the world's");
  script.line("fog(" + medium_py(script, *scene.sensor.medium) + ")");
}

}  // namespace

void write_lights(CyclesScript& script) {
  const SceneDescription& scene = script.scene();
  const bool hides = scene.integrator.limits().hide_emitters;
  int number = 0;
  for (const EmitterDescription& emitter : scene.emitters) {
    const std::string name = "light_" + std::to_string(number++);
    script.explain(name + " of " + scene.where(emitter.loc));
    std::visit(Light{script, emitter, name, hides}, emitter.light);
  }
  write_fog(script);
}

}  // namespace photonproof::inline reference_cycles
