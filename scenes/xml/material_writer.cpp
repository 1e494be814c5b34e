#include "scenes/xml/material_writer.h"

#include "scenes/description/description.h"
#include "scenes/xml/plugin_writer.h"

namespace photonproof::inline scenes_xml {
void MaterialWriter::write_named() {
  for (const TextureDescription& texture : scene_.textures)
    if (!texture.id.empty()) write(texture, "");
  for (const MediumDescription& medium : scene_.media)
    if (!medium.id.empty()) write(medium, "");
  for (const BsdfDescription& bsdf : scene_.bsdfs)
    if (!bsdf.id.empty()) write(bsdf);
}

void MaterialWriter::use(const std::string& name, const Colour& colour) {
  if (const auto* texture = std::get_if<TextureIndex>(&colour))
    use(name, *texture);
  else
    xml_.rgb(name, constant(colour));
}

void MaterialWriter::use(const std::string& name, const Scalar& number) {
  if (const auto* texture = std::get_if<TextureIndex>(&number))
    use(name, *texture);
  else
    xml_.number(name, std::get<double>(number));
}

void MaterialWriter::use(const std::string& name, const VolumeColour& volume) {
  if (const auto* colour = std::get_if<RgbD>(&volume)) return xml_.rgb(name, *colour);
  PluginWriter writer(*this, xml_, "volume", "", name);
  if (auto constant = std::get_if<ConstantVolumeDescription>(&volume)) {
    ConstantVolumeDescription d = *constant;
    describe(writer, d);
  } else {
    GridVolumeDescription d = std::get<GridVolumeDescription>(volume);
    describe(writer, d);
  }
  xml_.close();
}

void MaterialWriter::use(const std::string& name, const VolumeNumber& volume) {
  if (const auto* grid = std::get_if<GridVolumeDescription>(&volume)) return use(name, VolumeColour(*grid));
  xml_.number(name, std::get<double>(volume));
}

void MaterialWriter::use(const std::string& name, TextureIndex index) {
  const TextureDescription& texture = scene_.textures.at(index.value);
  if (texture.id.empty()) return write(texture, name);
  XmlWriter::Attributes attributes = {{"id", texture.id}};
  if (!name.empty()) attributes.emplace_back("name", name);
  xml_.leaf("ref", attributes);
}

void MaterialWriter::use(BsdfIndex index) {
  const BsdfDescription& bsdf = scene_.bsdfs.at(index.value);
  if (bsdf.id.empty()) return write(bsdf);
  xml_.leaf("ref", {{"id", bsdf.id}});
}

void MaterialWriter::use(const std::string& name, MediumIndex index) {
  const MediumDescription& medium = scene_.media.at(index.value);
  if (medium.id.empty()) return write(medium, name);
  xml_.leaf("ref", {{"id", medium.id}, {"name", name}});
}

void MaterialWriter::write(TextureDescription texture, const std::string& name) {
  PluginWriter writer(*this, xml_, "texture", texture.id, name);
  std::visit([&](auto& pattern) { describe(writer, pattern); }, texture.pattern);
  xml_.close();
}

void MaterialWriter::write(BsdfDescription bsdf) {
  PluginWriter writer(*this, xml_, "bsdf", bsdf.id);
  std::visit([&](auto& model) { describe(writer, model); }, bsdf.model);
  xml_.close();
}

template <class Phase>
void MaterialWriter::write_phase(Phase phase) {
  if (std::holds_alternative<IsotropicDescription>(phase)) return xml_.leaf("phase", {{"type", "isotropic"}});
  PluginWriter writer(*this, xml_, "phase", "");
  std::visit([&](auto& function) { describe(writer, function); }, phase);
  if constexpr (std::is_same_v<Phase, PhaseDescription>)
    if (const auto* blend = std::get_if<BlendPhaseDescription>(&phase)) {
      write_phase(blend->first);
      write_phase(blend->second);
    }
  xml_.close();
}

void MaterialWriter::write(MediumDescription medium, const std::string& name) {
  PluginWriter writer(*this, xml_, "medium", medium.id, name);
  std::visit(
      [&](auto& model) {
        describe(writer, model);
        write_phase(model.phase);
      },
      medium.model);
  xml_.close();
}

}  // namespace photonproof::inline scenes_xml
