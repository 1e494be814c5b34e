// Mitsuba 3's area emitter (nested in a shape) and point emitter (in the scene); defaults are its.
#include "scenes/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Light = decltype(EmitterDescription::light);

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

RgbD build_area(Params& params) { return params.colour("radiance", RgbD(1.0), 0, kUnbounded); }

Light build_point(Params& params) {
  PointLightDescription light;
  light.intensity = params.colour("intensity", RgbD(1.0), 0, kUnbounded);
  params.expect(!(params.has("position") && params.has("to_world")), "position",
                "is given beside to_world, expected one or the other");
  light.position =
      params.has("to_world") ? params.transform("to_world").point({0, 0, 0}) : params.point("position", light.position);
  return light;
}

const std::vector<Plugin<RgbD>>& shape_table() {
  static const std::vector<Plugin<RgbD>> rows = {{"area", {{"radiance", ParamType::colour}}, {}, build_area}};
  return rows;
}

const std::vector<Plugin<Light>>& scene_table() {
  static const std::vector<Plugin<Light>> rows = {
      {"point",
       {{"position", ParamType::point}, {"to_world", ParamType::transform}, {"intensity", ParamType::colour}},
       {},
       build_point}};
  return rows;
}

/// An emitter that exists, but not at this place.
void check_place(const Sources& sources, const Element& element, const std::string& type, const std::string& message) {
  const Attribute* given = element.find("type");
  if (given && given->value == type) sources.fail(given->at, "emitter '" + type + "' " + message);
}

}  // namespace

RgbD read_area_emitter(const Sources& sources, const Element& element) {
  check_place(sources, element, "point", "cannot stand in a shape, expected it directly in <scene>");
  return build_plugin(sources, element, shape_table());
}

EmitterDescription read_emitter(const Sources& sources, const Element& element) {
  check_place(sources, element, "area", "needs a surface, expected it inside a <shape>");
  return {sources.loc(element.at), id_of(element), build_plugin(sources, element, scene_table())};
}

}  // namespace photonproof::scene_xml
