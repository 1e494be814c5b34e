// The tables of docs/formats/scene.md are made from the functions that readers and writers use.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "scenes/description/description.h"
#include "scenes/dialect/stand_ins.h"
#include "scenes/files/atomic_file.h"
#include "scenes/parser/plugin_rows.h"

namespace photonproof::scene_xml {
namespace {

template <class Description>
PluginRows rows_of(Description description = {}) {
  PluginRows rows;
  describe(rows, description);
  return rows;
}

/// One a kind of the variant.
template <class... Kinds>
std::vector<PluginRows> rows_of_kinds(const std::variant<Kinds...>*) {
  return {rows_of<Kinds>()...};
}
template <class Variant>
std::vector<PluginRows> rows_of_kinds() {
  return rows_of_kinds(static_cast<const Variant*>(nullptr));
}

std::string in_backquotes(const std::string& text) { return "`" + text + "`"; }

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += (cell.empty() ? "" : " " + cell) + " |";
  return text + "\n";
}

/// The table of one kind. A parameter that an earlier plugin already has in the same form is only named.
std::string table(const std::string& tag, const std::vector<PluginRows>& plugins) {
  std::string text = "### " + tag + "\n\n" + line({"plugin", "parameter", "default", "values", "meaning"}) +
                     line({"---", "---", "---", "---", "---"});
  std::set<std::string> shown;
  for (const PluginRows& plugin : plugins) {
    std::string known, own;
    const auto add = [&](const std::string& name, const std::vector<std::string>& rest) {
      const std::string row = line({"", name, rest[0], rest[1], rest[2]});
      if (shown.insert(row).second)
        own += row;
      else
        known += (known.empty() ? "" : ", ") + name;
    };
    for (const ParamRow& row : plugin.rows) add(in_backquotes(row.name), {row.fallback, row.values, row.meaning});
    for (const NestedSpec& nested : plugin.nested_specs) add("nested `" + nested.tag + "`", {"", "", nested.meaning});
    text +=
        line({in_backquotes(plugin.type), known + (known.empty() ? "" : " as above"), "", "", plugin.meaning}) + own;
  }
  return text + "\n";
}

std::string all_tables() {
  auto integrators = rows_of_kinds<decltype(IntegratorDescription::method)>();
  integrators.push_back(rows_of<MomentPlugin>());
  auto shapes = rows_of_kinds<decltype(ShapeDescription::geometry)>();
  MeshDescription obj;
  obj.format = MeshDescription::Format::obj;
  obj.flip_tex_coords = true;
  shapes.push_back(rows_of(obj));
  CurvesDescription linear;
  linear.basis = CurvesDescription::Basis::linear;
  shapes.push_back(rows_of(linear));
  EllipsoidsDescription shells;
  shells.triangles = true;
  shapes.push_back(rows_of(shells));
  MeshDescription serialized;
  serialized.format = MeshDescription::Format::serialized;
  shapes.push_back(rows_of(serialized));
  auto emitters = rows_of_kinds<decltype(EmitterDescription::light)>();
  emitters.push_back(rows_of<AreaEmitter>());
  emitters.push_back(rows_of<DirectionalAreaEmitter>());
  using Kind = ReconstructionFilter::Kind;
  std::vector<PluginRows> filters, samplers;
  for (const Kind kind :
       {Kind::box, Kind::tent, Kind::gaussian, Kind::mitchell, Kind::catmullrom, Kind::lanczos, Kind::sinc})
    filters.push_back(rows_of(ReconstructionFilter{.kind = kind}));
  for (const char* type : {"independent", "stratified", "multijitter", "orthogonal", "ldsampler"})
    samplers.push_back(rows_of(SamplerPlugin{.type = type}));
  return table("integrator", integrators) + table("sensor", rows_of_kinds<decltype(SensorDescription::camera)>()) +
         table("film", {rows_of<FilmDescription>()}) + table("rfilter", filters) + table("sampler", samplers) +
         table("shape", shapes) + table("bsdf", rows_of_kinds<decltype(BsdfDescription::model)>()) +
         table("texture", rows_of_kinds<decltype(TextureDescription::pattern)>()) + table("emitter", emitters) +
         table("medium", rows_of_kinds<decltype(MediumDescription::model)>()) +
         table("phase", rows_of_kinds<PhaseDescription>()) +
         table("volume", {rows_of<GridVolumeDescription>(), rows_of<ConstantVolumeDescription>()});
}

/// The parameters that are accepted without an effect, a row a kind of object.
std::string harmless_table() {
  std::map<std::string_view, std::string> names;
  for (const HarmlessParameter& row : harmless_parameters()) {
    std::string& text = names[row.tag];
    text += (text.empty() ? "" : ", ") + in_backquotes(std::string(row.name));
  }
  std::string text = line({"object", "parameters"}) + line({"---", "---"});
  for (const auto& [tag, listed] : names) text += line({in_backquotes(std::string(tag)), listed});
  return text;
}

std::string stand_in_table() {
  std::string text = line({"object", "of others", "rendered as", "difference"}) + line({"---", "---", "---", "---"});
  for (const StandIn& row : stand_ins())
    text += line({std::string(row.tag), in_backquotes(std::string(row.type)), in_backquotes(std::string(row.becomes)),
                  row.loss.empty() ? "none" : std::string(row.loss)});
  return text;
}

TEST(scene_format, page_has_what_stands_in_for_what_others_have) {
  const std::string page = read_file(PHOTONPROOF_SOURCE_DIR "/docs/formats/scene.md");
  for (const std::string& table : {harmless_table(), stand_in_table()})
    EXPECT_NE(page.find(table), std::string::npos) << "put this in the page:\n" << table;
}

TEST(scene_format, page_has_the_tables_that_readers_and_writers_go_by) {
  const std::string page = read_file(PHOTONPROOF_SOURCE_DIR "/docs/formats/scene.md"), expected = all_tables();
  const std::size_t from = page.find("### integrator\n"), to = page.find("\n## ", from);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from, to + 1 - from), expected) << "put this in the page:\n" << expected;
}

}  // namespace
}  // namespace photonproof::scene_xml
