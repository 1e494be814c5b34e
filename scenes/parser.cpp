// Scene-level rules: who may stand where, how often, and which id means what. Values are read in plugins_*.cpp.
#include "scenes/parser.h"

#include <optional>

#include "scenes/atomic_file.h"
#include "scenes/expand.h"
#include "scenes/plugins.h"

namespace photonproof {
namespace {

using namespace scene_xml;

class SceneReader {
 public:
  SceneReader(const Sources& sources, const Element& root, const ParseOptions& options)
      : sources_(sources), root_(root), meshes_(sources, options) {}

  SceneDescription run() {
    scene_.files = sources_.names();
    register_ids(root_);
    read_named_bsdfs(root_);
    for (const Element& child : root_.children) read_child(child);
    if (!sensor_) sources_.fail(root_.at, "the scene has no <sensor>, expected one");
    scene_.sensor = *sensor_;
    scene_.integrator = integrator_.value_or(IntegratorDescription{sources_.loc(root_.at), PathDescription{}});
    check_lit();
    return std::move(scene_);
  }

 private:
  struct Named {
    const Element* element;
    std::optional<BsdfIndex> bsdf;
  };

  void register_ids(const Element& element) {
    if (const Attribute* id = element.tag == "ref" ? nullptr : element.find("id")) {
      if (id->value.empty()) fail_at(sources_, *id, "the id is empty, expected a name");
      const auto [known, is_new] = named_.try_emplace(id->value, Named{&element, std::nullopt});
      if (!is_new)
        fail_at(sources_, *id,
                "id " + in_quotes(id->value) + " is already used at " +
                    scene_.where(sources_.loc(known->second.element->at)));
    }
    for (const Element& child : element.children) register_ids(child);
  }

  /// BSDFs with an id come first in the table, in the order of the file, so that a <ref> may precede what it names.
  void read_named_bsdfs(const Element& element) {
    for (const Element& child : element.children) {
      if (child.tag == "bsdf" && child.find("id")) named_.at(id_of(child)).bsdf = add_bsdf(child);
      if (child.tag == "shape") read_named_bsdfs(child);
    }
  }

  BsdfIndex add_bsdf(const Element& element) {
    scene_.bsdfs.push_back(read_bsdf(sources_, element));
    return last_bsdf();
  }

  BsdfIndex last_bsdf() const { return {static_cast<std::uint32_t>(scene_.bsdfs.size() - 1)}; }

  void read_child(const Element& child) {
    if (child.tag == "bsdf") {
      if (!child.find("id")) sources_.fail(child.at, "a <bsdf> outside a shape needs the attribute 'id' to be of use");
    } else if (child.tag == "shape") {
      scene_.shapes.push_back(read_shape(sources_, child, meshes_));
      scene_.shapes.back().bsdf = bsdf_of(child);
    } else if (child.tag == "emitter") {
      scene_.emitters.push_back(read_emitter(sources_, child));
    } else if (child.tag == "sensor") {
      if (sensor_) sources_.fail(child.at, "a second <sensor>, expected exactly one");
      sensor_ = read_sensor(sources_, child);
    } else if (child.tag == "integrator") {
      if (integrator_) sources_.fail(child.at, "a second <integrator>, expected at most one");
      integrator_ = read_integrator(sources_, child);
    } else {
      const std::vector<std::string> known = {"bsdf", "shape", "emitter", "sensor", "integrator", "default", "include"};
      sources_.fail(child.at, "<" + child.tag + "> is not supported in <scene>" + did_you_mean(child.tag, known) +
                                  ", expected " + join_or(known));
    }
  }

  BsdfIndex bsdf_of(const Element& shape) {
    const Element* nested = find_nested(shape, "bsdf");
    const Element* ref = find_nested(shape, "ref");
    if (nested && ref) sources_.fail(ref->at, title_of(sources_, shape) + " has a second BSDF, expected one");
    if (ref) return resolve(*ref);
    if (nested) return nested->find("id") ? *named_.at(id_of(*nested)).bsdf : add_bsdf(*nested);
    scene_.bsdfs.push_back({sources_.loc(shape.at), "", DiffuseDescription{}});
    return last_bsdf();
  }

  BsdfIndex resolve(const Element& ref) const {
    check_attributes(sources_, ref, {"id", "name"});
    const Attribute& id = require(sources_, ref, "id");
    if (!ref.children.empty()) sources_.fail(ref.children.front().at, "<ref> cannot contain elements");
    const auto found = named_.find(id.value);
    if (found == named_.end())
      fail_at(sources_, id, "no bsdf has the id " + in_quotes(id.value) + did_you_mean(id.value, bsdf_ids()));
    if (!found->second.bsdf)
      fail_at(sources_, id,
              in_quotes(id.value) + " is a <" + found->second.element->tag + ">, expected the id of a <bsdf>");
    return *found->second.bsdf;
  }

  std::vector<std::string> bsdf_ids() const {
    std::vector<std::string> ids;
    for (const auto& [id, named] : named_)
      if (named.bsdf) ids.push_back(id);
    return ids;
  }

  /// A scene without light would render black without a word.
  void check_lit() const {
    const auto emits = [](const RgbD& colour) { return max_component(colour) > 0; };
    for (const ShapeDescription& shape : scene_.shapes)
      if (shape.radiance && emits(constant(*shape.radiance))) return;
    for (const EmitterDescription& emitter : scene_.emitters)
      if (const auto* point = std::get_if<PointLightDescription>(&emitter.light); !point || emits(point->intensity))
        return;
    sources_.fail(root_.at, "the scene has no light: expected an <emitter> whose radiance or intensity is above 0");
  }

  const Sources& sources_;
  const Element& root_;
  MeshFiles meshes_;
  SceneDescription scene_;
  std::map<std::string, Named> named_;
  std::optional<SensorDescription> sensor_;
  std::optional<IntegratorDescription> integrator_;
};

}  // namespace

SceneDescription parse_scene_file(const std::string& path, const ParseOptions& options) {
  return parse_scene_text(read_file(path, kMaxFileBytes), path, options);
}

SceneDescription parse_scene_text(std::string_view text, const std::string& name, const ParseOptions& options) {
  if (text.size() > kMaxFileBytes)
    throw InputError(
        name, "text has " + std::to_string(text.size()) + " bytes, the limit is " + std::to_string(kMaxFileBytes));
  Sources sources;
  const int file = sources.add(name, std::string(text));
  const Element root = expand_scene(sources, file, options);
  return SceneReader(sources, root, options).run();
}

}  // namespace photonproof
