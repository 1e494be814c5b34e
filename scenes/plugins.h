// One function a kind of scene object; each file behind it holds a table with one row a plugin.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "scenes/description.h"
#include "scenes/edit_distance.h"
#include "scenes/params.h"
#include "scenes/scene_files.h"
#include "scenes/text_numbers.h"

namespace photonproof::scene_xml {

/// A row: the plugin's name, what parameters it takes, what objects may be nested in it, and how its value is built.
template <class Result>
struct Plugin {
  std::string type;
  std::vector<ParamSpec> params;
  std::vector<std::string> nested;
  Result (*build)(Params&);
};

/// "<tag> '<type>'", what messages call an object.
std::string title_of(const Sources& sources, const Element& object);

/// Throws unless every child is a parameter or one of `nested`, given at most once each.
void check_nested(const Sources& sources, const Element& object, const std::vector<std::string>& nested);

/// The row for `object`'s type; checks its attributes and children. Throws on an unknown type, naming the nearest.
template <class Result>
const Plugin<Result>& find_plugin(const Sources& sources, const Element& object,
                                  const std::vector<Plugin<Result>>& table) {
  check_attributes(sources, object, {"type", "id", "name"});
  const Attribute& type = require(sources, object, "type");
  for (const Plugin<Result>& plugin : table)
    if (plugin.type == type.value) {
      check_nested(sources, object, plugin.nested);
      return plugin;
    }
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const Plugin<Result>& plugin : table) names.push_back(plugin.type);
  fail_at(sources, type,
          object.tag + " " + in_quotes(type.value) + " is not supported" + did_you_mean(type.value, names) +
              ", expected " + join_or(names));
}

/// Finds the row, reads the parameters and checks that all were used.
template <class Result>
Result build_plugin(const Sources& sources, const Element& object, const std::vector<Plugin<Result>>& table) {
  const Plugin<Result>& plugin = find_plugin(sources, object, table);
  Params params(sources, object, title_of(sources, object), plugin.params);
  Result result = plugin.build(params);
  params.finish();
  return result;
}

/// The child with this tag, or null.
const Element* find_nested(const Element& object, std::string_view tag);

/// The `id` attribute, empty without one.
std::string id_of(const Element& object);

BsdfDescription read_bsdf(const Sources& sources, const Element& element);
/// All of a shape but its `bsdf`.
ShapeDescription read_shape(const Sources& sources, const Element& element, MeshFiles& meshes);
/// The radiance of an <emitter type="area">.
RgbD read_area_emitter(const Sources& sources, const Element& element);
EmitterDescription read_emitter(const Sources& sources, const Element& element);
SensorDescription read_sensor(const Sources& sources, const Element& element);
IntegratorDescription read_integrator(const Sources& sources, const Element& element);

}  // namespace photonproof::scene_xml
