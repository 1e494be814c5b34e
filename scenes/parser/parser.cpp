// Scene-level rules: the place and number of objects, and the meaning of ids. Values are read in plugins_*.cpp.
#include "scenes/parser/parser.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

#include "scenes/description/sensors.h"
#include "scenes/dialect/as_mitsuba.h"
#include "scenes/dialect/element_edit.h"
#include "scenes/dialect/model_file.h"
#include "scenes/dialect/stand_ins.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/parser/expand.h"
#include "scenes/parser/plugins.h"
#include "scenes/parser/scene_objects.h"

namespace photonproof::inline scenes_parser {
namespace {

using namespace scene_xml;

bool is_group(const Element& element) {
  const Attribute* type = element.find("type");
  return element.tag == "shape" && type && type->value == "shapegroup";
}

/// The tables are filled in the writer's order, so that its text reads back the same. First come named textures, media
/// and BSDFs, then shape groups, shapes, emitters and the sensor with their nested objects.
class SceneReader {
 public:
  SceneReader(const Sources& sources, const SceneFolders& folders, const Element& root)
      : sources_(sources), root_(root), files_(sources, folders), objects_(start(), root, files_, scene_) {}

  SceneDescription run(const ParseOptions& options) {
    check_children();
    objects_.read_named();
    for_each("shape", [&](const Element& e) {
      if (is_group(e)) objects_.shape_group(e);
    });
    for_each("shape", [&](const Element& e) {
      if (!is_group(e)) scene_.shapes.push_back(read_shape(objects_, e));
    });
    for_each("emitter", [&](const Element& e) {
      if (value_of(e, "type") != "area" || !e.find("id"))  // shapes refer to it
        scene_.emitters.push_back(read_emitter(objects_, e));
    });
    scene_.integrator = {sources_.loc(root_.at), PathDescription{}};
    read_sensor_number(options.sensor);
    for_each("integrator", [&](const Element& e) { scene_.integrator = read_integrator(objects_, e); });
    std::visit([&](auto& method) { take_lights_of_no_edges(method); }, scene_.integrator.method);
    objects_.obstacles().attempt([&] { check_environments(); });
    if (objects_.obstacles().none()) check_lit();
    if (!options.lenient) objects_.obstacles().raise();
    for (const InputError& error : objects_.obstacles().errors())
      scene_.notes.push_back({error.place(), "left out: " + error.message()});
    return std::move(scene_);
  }

 private:
  const Sources& start() {
    scene_.files = sources_.names();
    return sources_;
  }

  /// An object that cannot be read is left out, and is an obstacle.
  template <class Action>
  void for_each(const std::string& tag, Action action) {
    for (const Element& child : root_.children)
      if (child.tag == tag) objects_.obstacles().attempt([&] { action(child); });
  }

  /// A sensor of the scene, or of a shape.
  struct GivenSensor {
    const Element *sensor, *shape;
  };

  void read_sensor_number(int number) {
    std::vector<GivenSensor> sensors;
    for (const Element& child : root_.children)
      if (child.tag == "sensor") sensors.push_back({&child, nullptr});
    for (const Element& shape : root_.children)
      if (shape.tag == "shape")
        for (const Element& child : shape.children)
          if (child.tag == "sensor") sensors.push_back({&child, &shape});
    if (sensors.empty()) {
      scene_.sensor = sensor_around(scene_, false);
      scene_.notes.push_back({scene_.where(sources_.loc(root_.at)),
                              "no <sensor>: a perspective camera of 45 degrees sees the whole scene from -z"});
      return;
    }
    if (number < 0 || static_cast<std::size_t>(number) >= sensors.size())
      throw InputError("--sensor", std::to_string(number) + " is not a sensor of the scene, expected 0 to " +
                                       std::to_string(sensors.size() - 1));
    objects_.obstacles().attempt([&] { read_given_sensor(sensors[static_cast<std::size_t>(number)]); });
  }

  void read_given_sensor(const GivenSensor& given) {
    scene_.sensor = read_sensor(objects_, *given.sensor);
    const bool is_irradiance = std::holds_alternative<IrradianceMeterDescription>(scene_.sensor.camera);
    if (is_irradiance != (given.shape != nullptr))
      sources_.fail(given.sensor->at, is_irradiance
                                          ? "sensor 'irradiancemeter' needs a surface, expected it inside a <shape>"
                                          : "the sensor of a shape is no 'irradiancemeter'");
    if (given.shape == nullptr) return;
    const SourceLoc loc = sources_.loc(given.shape->at);
    for (ShapeDescription& shape : scene_.shapes) shape.measures = shape.loc == loc;
  }

  void check_children() {
    const std::vector<std::string> known = {"bsdf",       "texture", "medium",  "shape",   "emitter", "sensor",
                                            "integrator", "film",    "sampler", "rfilter", "phase",   "volume",
                                            "spectrum",   "ref",     "default", "include", "path",    "alias"};
    int integrators = 0;
    for (const Element& child : root_.children)
      objects_.obstacles().attempt([&] {
        if (std::find(known.begin(), known.end(), child.tag) == known.end())
          sources_.fail(child.at, "<" + child.tag + "> is not supported in <scene>" + did_you_mean(child.tag, known) +
                                      ", expected " + join_or(known));
        if (child.tag == "integrator" && ++integrators > 1)
          sources_.fail(child.at, "a second <integrator>, expected at most one");
      });
  }

  bool is_bright(const Colour& colour) {
    const auto* texture = std::get_if<TextureIndex>(&colour);
    return (texture ? objects_.largest_value(*texture) : max_component(constant(colour))) > 0;
  }

  bool is_bright(const EmitterDescription& emitter) {
    if (const auto* map = std::get_if<EnvmapDescription>(&emitter.light))
      if (objects_.largest_value(*map->image) <= 0) return false;
    return std::visit([](const auto& light) { return !light.is_dark(); }, emitter.light);
  }

  void take_lights_of_no_edges(PathLimits& limits) {
    if (limits.max_depth != 0) return;
    limits.max_depth = 1;
    scene_.emitters.clear();
    for (ShapeDescription& shape : scene_.shapes) shape.radiance.reset();
  }

  /// Notes a scene without light. Radiance fields have colours of their own.
  void check_lit() {
    if (std::holds_alternative<RadianceFieldDescription>(scene_.integrator.method)) return;
    for (const ShapeDescription& shape : scene_.shapes)
      if (shape.radiance && is_bright(*shape.radiance)) return;
    for (const EmitterDescription& emitter : scene_.emitters)
      if (is_bright(emitter)) return;
    scene_.notes.push_back({scene_.where(sources_.loc(root_.at)), "the scene has no light: its image is black"});
  }

  void check_environments() {
    int environments = 0;
    for_each("emitter", [&](const Element& e) {
      const std::string& type = require(sources_, e, "type").value;
      if ((type == "constant" || type == "envmap" || type == "sunsky") && ++environments > 1)
        sources_.fail(e.at, "a second environment emitter, expected at most one of constant, envmap and sunsky");
    });
  }

  const Sources& sources_;
  const Element& root_;
  SceneFiles files_;
  SceneDescription scene_;
  SceneObjects objects_;
};

/// A line of a text that was made of a model is no place that anybody can look at.
void forget_lines(SceneDescription& scene) {
  const auto forget = [](auto& entities) {
    for (auto& entity : entities) entity.loc = {};
  };
  forget(scene.textures);
  forget(scene.bsdfs);
  forget(scene.media);
  forget(scene.groups);
  for (ShapeGroupDescription& group : scene.groups) forget(group.shapes);
  forget(scene.shapes);
  forget(scene.emitters);
  scene.sensor.loc = {};
  scene.integrator.loc = {};
}

}  // namespace

SceneDescription parse_model_file(const std::string& path, const std::string& folder, const ParseOptions& options) {
  const ModelScene model =
      read_model(path, folder, {.allow_outside = options.allow_outside, .lenient = options.lenient});
  SceneDescription scene = parse_scene_text(model.text, (model.folder / "scene.xml").string(), options);
  scene.notes = model.notes;
  scene.files.insert(scene.files.end(), model.included.begin(), model.included.end());
  if (model.text.find("<sensor") == std::string::npos) {
    scene.sensor = sensor_around(scene, true);
    scene.notes.push_back({path, "no camera: one of 45 degrees sees the whole model from +z"});
  }
  return scene;
}

SceneDescription parse_scene_file(const std::string& path, const ParseOptions& options) {
  if (!is_model(path)) return parse_scene_text(read_file(path, kMaxFileBytes), path, options);
  const ScratchFolder scratch("model");  // its files are read before it goes
  SceneDescription scene = parse_model_file(path, scratch.path().string(), options);
  forget_lines(scene);
  scene.files.front() = path;  // in place of what was made of it
  return scene;
}

SceneDescription parse_scene_text(std::string_view text, const std::string& name, const ParseOptions& options) {
  if (text.size() > kMaxFileBytes)
    throw InputError(
        name, "text has " + std::to_string(text.size()) + " bytes, the limit is " + std::to_string(kMaxFileBytes));
  Sources sources;
  SceneFolders folders(sources, options);
  const int file = sources.add(name, std::string(text));
  Element root = expand_scene(sources, file, folders, options);
  std::vector<SceneNote> notes = use_stand_ins(sources, root);
  if (options.as_mitsuba) std::ranges::copy(rotate_as_mitsuba(sources, root), std::back_inserter(notes));
  SceneDescription scene = SceneReader(sources, folders, root).run(options);
  scene.notes.insert(scene.notes.begin(), notes.begin(), notes.end());
  if (options.as_mitsuba) follow_mitsuba(scene);
  for (const auto& [define, value] : options.defines) scene.defines.push_back(define + "=" + value);
  if (options.as_mitsuba) scene.defines.push_back("--as-mitsuba");
  if (options.sensor != 0) scene.defines.push_back("--sensor=" + std::to_string(options.sensor));
  return scene;
}

}  // namespace photonproof::inline scenes_parser
