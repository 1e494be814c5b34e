#include "scenes/parser/scene_objects.h"

#include <algorithm>
#include <type_traits>

#include "scenes/base/edit_distance.h"
#include "scenes/base/text_numbers.h"
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {

SceneObjects::SceneObjects(const Sources& sources, const Element& root, SceneFiles& files, SceneDescription& scene)
    : sources_(sources), root_(root), files_(files), scene_(scene) {
  register_ids(root_);
  for (const Element& child : root_.children)
    if (child.tag == "alias") obstacles_.attempt([&] { register_alias(child); });
}

void SceneObjects::register_ids(const Element& element) {
  const bool names_another = element.tag == "ref" || element.tag == "alias";
  if (const Attribute* id = names_another ? nullptr : element.find("id"))
    obstacles_.attempt([&] { register_id(*id, element); });
  for (const Element& child : element.children) register_ids(child);
}

void SceneObjects::register_id(const Attribute& id, const Element& element) {
  if (id.value.empty()) fail_at(sources_, id, "the id is empty, expected a name");
  const auto [known, is_new] = named_.try_emplace(id.value, &element);
  if (!is_new)
    fail_at(sources_, id,
            "id " + in_quotes(id.value) + " is already used at " + scene_.where(sources_.loc(known->second->at)));
}

void SceneObjects::register_alias(const Element& element) {
  check_attributes(sources_, element, {"id", "as"});
  const Element& named = target(element);
  register_id(require(sources_, element, "as"), named);
}

const Element& SceneObjects::target(const Element& element) const {
  if (element.tag != "ref" && element.tag != "alias") return element;
  if (element.tag == "ref") check_attributes(sources_, element, {"id", "name"});
  if (!element.children.empty())
    sources_.fail(element.children.front().at, "<" + element.tag + "> cannot contain elements");
  const Attribute& id = require(sources_, element, "id");
  const auto found = named_.find(id.value);
  if (found != named_.end()) return *found->second;
  std::vector<std::string> ids;
  for (const auto& [name, named] : named_) ids.push_back(name);
  fail_at(sources_, id, "nothing has the id " + in_quotes(id.value) + did_you_mean(id.value, ids));
}

template <class Action>
void SceneObjects::for_each_named(const Element& element, const std::string& tag, Action action) {
  for (const Element& child : element.children) {
    if (child.tag == tag && child.find("id")) action(child);
    for_each_named(child, tag, action);
  }
}

void SceneObjects::read_named() {
  for_each_named(root_, "texture", [&](const Element& e) { texture(e); });
  for_each_named(root_, "medium", [&](const Element& e) { medium(e); });
  for_each_named(root_, "bsdf", [&](const Element& e) { bsdf(e); });
}

template <class Read>
void SceneObjects::read_named_inside(const Element& element, const std::string& tag, Read read) {
  for (const Element& child : element.children) {
    if (child.tag != tag && child.tag != "ref") continue;
    const Element& nested = target(child);
    if (nested.tag != tag) continue;
    if (nested.find("id"))
      read(child);
    else
      read_named_inside(nested, tag, read);
  }
}

template <class Tag, class Build>
Index<Tag> SceneObjects::find_or_build(Known<Tag>& known, const Element& element, Build build) {
  const Element& object = target(element);
  const auto [found, is_new] = known.try_emplace(&object, std::nullopt);
  if (!is_new) {
    if (!found->second) sources_.fail(element.at, "<" + object.tag + "> " + in_quotes(id_of(object)) + " nests itself");
    return *found->second;
  }
  if (++depth_ > kMaxNesting)
    sources_.fail(element.at,
                  "objects nest and refer to each other more than " + std::to_string(kMaxNesting) + " deep");
  const Index<Tag> index = build(object);  // keeps its own errors
  --depth_;
  return *(known[&object] = index);
}

namespace {

template <class Tag, class Entity>
Index<Tag> append(std::vector<Entity>& table, Entity entity) {
  table.push_back(std::move(entity));
  return {static_cast<std::uint32_t>(table.size() - 1)};
}

}  // namespace

TextureIndex SceneObjects::texture(const Element& element) {
  return find_or_build(textures_, element, [&](const Element& object) {
    TextureDescription texture{sources_.loc(object.at), id_of(object),
                               CheckerboardDescription{RgbD(0.5), RgbD(0.5), {}}};
    TextureFacts facts{0.5, 1};
    obstacles_.attempt([&] {
      read_named_inside(object, "texture", [&](const Element& nested) { this->texture(nested); });
      const TextureDescription given = read_texture(*this, object);
      facts = facts_of(given);
      check_depth(element, facts.depth);
      texture = given;
    });
    textures_known_.push_back(facts);
    return append<TextureTag>(scene_.textures, std::move(texture));
  });
}

BsdfIndex SceneObjects::bsdf(const Element& element) {
  return find_or_build(bsdfs_, element, [&](const Element& object) {
    BsdfDescription bsdf{sources_.loc(object.at), id_of(object), DiffuseDescription{}};
    BsdfFacts facts{false, 1};
    obstacles_.attempt([&] {
      read_named_inside(object, "bsdf", [&](const Element& nested) { this->bsdf(nested); });
      const BsdfDescription given = read_bsdf(*this, object);
      facts = facts_of(given);
      check_depth(element, facts.depth);
      bsdf = given;
    });
    bsdfs_known_.push_back(facts);
    return append<BsdfTag>(scene_.bsdfs, std::move(bsdf));
  });
}

BsdfIndex SceneObjects::default_bsdf(const Element& shape, bool emits) {
  bsdfs_known_.push_back({false, 1});
  const DiffuseDescription diffuse = emits ? DiffuseDescription{RgbD(0.0)} : DiffuseDescription{};
  return append<BsdfTag>(scene_.bsdfs, {sources_.loc(shape.at), "", diffuse});
}

void SceneObjects::check_depth(const Element& element, int depth) const {
  if (depth > kMaxNesting)
    sources_.fail(element.at,
                  "objects nest and refer to each other more than " + std::to_string(kMaxNesting) + " deep");
}

SceneObjects::TextureFacts SceneObjects::facts_of(const TextureDescription& texture) {
  if (const auto* bitmap = std::get_if<BitmapDescription>(&texture.pattern)) return {largest_value(*bitmap->image), 1};
  // A mesh attribute's values are its mesh's; those that a shape shows are checked with the compiled scene.
  if (std::holds_alternative<MeshAttributeDescription>(texture.pattern)) return {0, 1};
  if (const auto* scaled = std::get_if<ScaledTextureDescription>(&texture.pattern)) {
    const TextureFacts& inner = textures_known_[scaled->texture.value];
    return {inner.largest * max_component(scaled->scale), inner.depth + 1};
  }
  if (const auto* volume = std::get_if<VolumeTextureDescription>(&texture.pattern))
    return {max_component(most(volume->volume)), 1};
  const auto& board = std::get<CheckerboardDescription>(texture.pattern);
  TextureFacts facts{0, 1};
  for (const Colour& colour : {board.color0, board.color1}) {
    const auto* nested = std::get_if<TextureIndex>(&colour);
    facts.largest = std::max(facts.largest, nested ? largest_value(*nested) : max_component(constant(colour)));
    if (nested) facts.depth = std::max(facts.depth, 1 + textures_known_[nested->value].depth);
  }
  return facts;
}

SceneObjects::BsdfFacts SceneObjects::facts_of(const BsdfDescription& bsdf) const {
  BsdfFacts facts{traits_of(bsdf).transmits, 1};
  for (const BsdfIndex index : nested_bsdfs(bsdf)) {
    facts.transmits = facts.transmits || bsdfs_known_[index.value].transmits;
    facts.depth = std::max(facts.depth, 1 + bsdfs_known_[index.value].depth);
  }
  return facts;
}

MediumIndex SceneObjects::medium(const Element& element) {
  return find_or_build(media_, element, [&](const Element& object) {
    MediumDescription medium{sources_.loc(object.at), id_of(object), HomogeneousDescription{.sigma_t = RgbD(0.0)}};
    obstacles_.attempt([&] { medium = read_medium(*this, object); });
    return append<MediumTag>(scene_.media, std::move(medium));
  });
}

double SceneObjects::largest_value(const Image& image) {
  const auto [found, is_new] = largest_texels_.try_emplace(&image, 0);
  if (is_new) found->second = *std::max_element(image.rgb.begin(), image.rgb.end());
  return found->second;
}

ShapeGroupIndex SceneObjects::shape_group(const Element& element) {
  return find_or_build(groups_, element, [&](const Element& object) {
    ShapeGroupDescription group{sources_.loc(object.at), id_of(object), {}};
    obstacles_.attempt([&] { group = read_shape_group(*this, object); });
    return append<ShapeGroupTag>(scene_.groups, std::move(group));
  });
}

}  // namespace photonproof::scene_xml
