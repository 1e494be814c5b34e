// Textures, BSDFs and media as scene XML, for writer.cpp.
#pragma once

#include <string>

#include "scenes/description/description.h"
#include "scenes/xml/xml_writer.h"

namespace photonproof::inline scenes_xml {

class MaterialWriter {
 public:
  MaterialWriter(const SceneDescription& scene, XmlWriter& xml) : scene_(scene), xml_(xml) {}

  /// Everything with an id, in the order of the tables.
  void write_named();

  // Nested objects: a <ref> to an object with an id, else the object itself.
  void use(const std::string& name, const Colour& colour);
  void use(const std::string& name, const Scalar& number);
  void use(const std::string& name, const VolumeColour& volume);
  void use(const std::string& name, const VolumeNumber& volume);
  void use(const std::string& name, TextureIndex index);
  void use(BsdfIndex index);
  void use(ShapeGroupIndex index) { xml_.leaf("ref", {{"id", scene_.groups.at(index.value).id}}); }
  void use(const std::string& name, MediumIndex index);

 private:
  // Copies, since `describe` serves readers, too.
  void write(TextureDescription texture, const std::string& name);
  void write(BsdfDescription bsdf);
  void write(MediumDescription medium, const std::string& name);
  template <class Phase>
  void write_phase(Phase phase);

  const SceneDescription& scene_;
  XmlWriter& xml_;
};

}  // namespace photonproof::inline scenes_xml
