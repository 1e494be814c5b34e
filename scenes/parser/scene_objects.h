// The objects of a scene that others nest or refer to by id. They become entries of the description's tables when they
// are first needed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/parser/scene_files.h"
#include "scenes/xml/obstacles.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

class SceneObjects {
 public:
  /// Collects the ids of everything below `root`. Throws InputError on an id that is empty or used twice.
  SceneObjects(const Sources& sources, const Element& root, SceneFiles& files, SceneDescription& scene);

  /// Reads everything that has an id, in the order of the file, except that nested objects come before their parents.
  /// Named objects come first in each table, so a <ref> may precede its target. Throws on an object that nests itself.
  void read_named();

  /// The target of a <ref>; any other element is itself. Throws when nothing has that id.
  const Element& target(const Element& element) const;

  /// The table's entry for an element or a <ref> to one, made at its first use. Every use of an element without an id
  /// makes its own.
  TextureIndex texture(const Element& element);
  BsdfIndex bsdf(const Element& element);
  MediumIndex medium(const Element& element);
  ShapeGroupIndex shape_group(const Element& element);

  /// The largest component of a texture's values.
  double largest_value(TextureIndex texture) const { return textures_known_[texture.value].largest; }
  double largest_value(const Image& image);

  /// Whether a BSDF or one nested in it transmits light.
  bool transmits(BsdfIndex bsdf) const { return bsdfs_known_[bsdf.value].transmits; }
  /// The BSDF of a shape without one, as in Mitsuba: diffuse, and black where the shape emits.
  BsdfIndex default_bsdf(const Element& shape, bool emits);

  const Sources& sources() const { return sources_; }
  SceneFiles& files() { return files_; }
  /// An object that cannot be read becomes an obstacle; a neutral one takes its place.
  Obstacles& obstacles() { return obstacles_; }
  SceneDescription& scene() { return scene_; }

 private:
  template <class Table>
  using Known = std::map<const Element*, std::optional<Index<Table>>>;  // empty while it is being read

  // Collected when an entry is made, so that no chain of references makes queries slow.
  struct TextureFacts {
    double largest;
    int depth;  // of nesting
  };
  struct BsdfFacts {
    bool transmits;
    int depth;
  };
  TextureFacts facts_of(const TextureDescription& texture);
  BsdfFacts facts_of(const BsdfDescription& bsdf) const;
  void check_depth(const Element& element, int depth) const;

  void register_ids(const Element& element);
  void register_id(const Attribute& id, const Element& element);
  void register_alias(const Element& element);
  template <class Action>
  void for_each_named(const Element& element, const std::string& tag, Action action);
  /// Reads the named objects of one kind that `element` nests or refers to, at any depth.
  template <class Read>
  void read_named_inside(const Element& element, const std::string& tag, Read read);
  template <class Tag, class Build>
  Index<Tag> find_or_build(Known<Tag>& known, const Element& element, Build build);

  const Sources& sources_;
  const Element& root_;
  SceneFiles& files_;
  SceneDescription& scene_;
  std::map<std::string, const Element*> named_;
  Known<TextureTag> textures_;
  Known<BsdfTag> bsdfs_;
  Known<MediumTag> media_;
  Known<ShapeGroupTag> groups_;
  std::map<const Image*, double> largest_texels_;
  std::vector<TextureFacts> textures_known_;  // parallel to the scene's tables
  std::vector<BsdfFacts> bsdfs_known_;
  int depth_ = 0;
  Obstacles obstacles_;
};

}  // namespace photonproof::scene_xml
