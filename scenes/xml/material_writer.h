// Textures, BSDFs and media as scene XML, for writer.cpp.
#pragma once

#include <string>

#include "scenes/description/description.h"
#include "scenes/xml/xml_writer.h"

namespace photonproof {

class MaterialWriter {
 public:
  MaterialWriter(const SceneDescription& scene, XmlWriter& xml) : scene_(scene), xml_(xml) {}

  /// Everything with an id, in the order of the tables.
  void write_named();

  // What another object nests: a <ref> to a thing with an id, else the thing itself.
  void use(const std::string& name, const Colour& colour);
  void use(const std::string& name, const Scalar& number);
  void use(const std::string& name, TextureIndex index);
  void use(BsdfIndex index);
  void use(const std::string& name, MediumIndex index);

 private:
  void write(const TextureDescription& texture, const std::string& name);
  void write(const BsdfDescription& bsdf);
  void write(const MediumDescription& medium, const std::string& name);

  const SceneDescription& scene_;
  XmlWriter& xml_;
};

}  // namespace photonproof
