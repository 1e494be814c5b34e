// One function per kind of scene object; the file of each holds a table with one row per plugin.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "scenes/base/edit_distance.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/description.h"
#include "scenes/parser/params.h"
#include "scenes/parser/scene_objects.h"

namespace photonproof::scene_xml {

/// A row: the plugin's name, its parameters, the objects that may be nested in it, and the function that builds its
/// value.
template <class Result>
struct Plugin {
  std::string type;
  std::vector<ParamSpec> params;
  std::vector<NestedSpec> nested;
  std::function<Result(Params&)> build;
};

/// "<tag> '<type>'", the name of an object in messages.
std::string title_of(const Sources& sources, const Element& object);

/// The row for `object`'s type; checks its attributes. Throws on an unknown type, naming the nearest.
template <class Result>
const Plugin<Result>& find_plugin(const Sources& sources, const Element& object,
                                  const std::vector<Plugin<Result>>& table) {
  check_attributes(sources, object, {"type", "id", "name"});
  const Attribute& type = require(sources, object, "type");
  for (const Plugin<Result>& plugin : table)
    if (plugin.type == type.value) return plugin;
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const Plugin<Result>& plugin : table) names.push_back(plugin.type);
  fail_at(sources, type,
          object.tag + " " + in_quotes(type.value) + " is not supported" + did_you_mean(type.value, names) +
              ", expected " + join_or(names));
}

/// Finds the row, reads the parameters and checks that all were used.
template <class Result>
Result build_plugin(SceneObjects& objects, const Element& object, const std::vector<Plugin<Result>>& table) {
  const Plugin<Result>& plugin = find_plugin(objects.sources(), object, table);
  Params params(objects, object, title_of(objects.sources(), object), plugin.params, plugin.nested);
  Result result = plugin.build(params);
  params.finish();
  return result;
}

/// The `id` attribute, empty without one.
std::string id_of(const Element& object);

template <class Result>
void sort_by_name(std::vector<Plugin<Result>>& table) {
  std::sort(table.begin(), table.end(), [](const auto& a, const auto& b) { return a.type < b.type; });
}

/// Throws where both are given.
void expect_alone(const Params& params, const std::string& name, const std::string& other);
/// A direction of length 1. One of that length already is unchanged, so that writing and reading do not wear it down.
Vec3d unit_vector(Params& params, const std::string& name, const Vec3d& fallback);

/// "bk7" or a number, above 0.
double read_ior(Params& params, const std::string& name, double fallback);

/// eta and k, those of a named material, or nothing for the perfect mirror "none".
std::optional<ComplexIor> read_conductor_ior(Params& params);

/// Whether the images of the local x, y and z axes are perpendicular, within six printed digits of a matrix.
bool is_perpendicular(const Vec3d& a, const Vec3d& b);
/// Whether they are perpendicular and of one length, not 0: the transform turns, moves, scales and may mirror.
bool is_even(const Transform& t);
/// Throws unless `to_world` is even and does not mirror; `what` is "a sphere".
void expect_similarity(Params& params, const std::string& what);

TextureDescription read_texture(SceneObjects& objects, const Element& element);
BsdfDescription read_bsdf(SceneObjects& objects, const Element& element);
MediumDescription read_medium(SceneObjects& objects, const Element& element);
VolumeColour read_volume(SceneObjects& objects, const Element& element);
ShapeDescription read_shape(SceneObjects& objects, const Element& element);
/// The shapes that an <shape type="shapegroup"> holds.
ShapeGroupDescription read_shape_group(SceneObjects& objects, const Element& element);
/// The radiance of an <emitter type="area"> or, along the normal, of a "directionalarea".
struct ShapeEmission {
  Colour radiance;
  bool along_normal = false;
};
ShapeEmission read_shape_emitter(SceneObjects& objects, const Element& element);
EmitterDescription read_emitter(SceneObjects& objects, const Element& element);
SensorDescription read_sensor(SceneObjects& objects, const Element& element);
FilmDescription read_film(SceneObjects& objects, const Element& element);
IntegratorDescription read_integrator(SceneObjects& objects, const Element& element);

}  // namespace photonproof::scene_xml
