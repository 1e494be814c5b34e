#include "scenes/xml/material_writer.h"

namespace photonproof {
namespace {

const char* name_of(TextureFilter filter) { return filter == TextureFilter::nearest ? "nearest" : "bilinear"; }

const char* name_of(TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::repeat:
      return "repeat";
    case TextureWrap::mirror:
      return "mirror";
    case TextureWrap::clamp:
      break;
  }
  return "clamp";
}

const char* name_of(MicrofacetDistribution distribution) {
  return distribution == MicrofacetDistribution::ggx ? "ggx" : "beckmann";
}

const char* type_of(const DiffuseDescription&) { return "diffuse"; }
const char* type_of(const ConductorDescription&) { return "conductor"; }
const char* type_of(const RoughConductorDescription&) { return "roughconductor"; }
const char* type_of(const DielectricDescription&) { return "dielectric"; }
const char* type_of(const ThinDielectricDescription&) { return "thindielectric"; }
const char* type_of(const RoughDielectricDescription&) { return "roughdielectric"; }
const char* type_of(const PlasticDescription&) { return "plastic"; }
const char* type_of(const RoughPlasticDescription&) { return "roughplastic"; }
const char* type_of(const PhongDescription&) { return "phong"; }
const char* type_of(const LayeredDescription&) { return "layered"; }
const char* type_of(const TwoSidedDescription&) { return "twosided"; }
const char* type_of(const MaskDescription&) { return "mask"; }
const char* type_of(const BlendDescription&) { return "blendbsdf"; }
const char* type_of(const NullDescription&) { return "null"; }
const char* type_of(const BumpMapDescription&) { return "bumpmap"; }
const char* type_of(const NormalMapDescription&) { return "normalmap"; }

/// The parameters and nested objects of a BSDF.
class BsdfContent {
 public:
  BsdfContent(MaterialWriter& materials, XmlWriter& xml) : materials_(materials), xml_(xml) {}

  void operator()(const DiffuseDescription& m) { materials_.use("reflectance", m.reflectance); }
  void operator()(const ConductorDescription& m) {
    conductor(m.ior);
    materials_.use("specular_reflectance", m.specular_reflectance);
  }
  void operator()(const RoughConductorDescription& m) {
    microfacets(m);
    alphas(m);
    conductor(m.ior);
    materials_.use("specular_reflectance", m.specular_reflectance);
  }
  void operator()(const DielectricDescription& m) {
    dielectric(m);
    if (m.priority) xml_.integer("priority", *m.priority);
  }
  void operator()(const ThinDielectricDescription& m) { dielectric(m); }
  void operator()(const RoughDielectricDescription& m) {
    microfacets(m);
    alphas(m);
    dielectric(m);
  }
  void operator()(const PlasticDescription& m) { plastic(m); }
  void operator()(const RoughPlasticDescription& m) {
    microfacets(m);
    xml_.number("alpha", m.alpha);
    plastic(m);
  }
  void operator()(const PhongDescription& m) {
    materials_.use("exponent", m.exponent);
    materials_.use("diffuse_reflectance", m.diffuse_reflectance);
    materials_.use("specular_reflectance", m.specular_reflectance);
  }
  void operator()(const LayeredDescription& m) {
    iors(m);
    xml_.rgb("sigma_a", m.sigma_a);
    xml_.number("thickness", m.thickness);
    materials_.use("specular_reflectance", m.specular_reflectance);
    materials_.use(m.base);
  }
  void operator()(const TwoSidedDescription& m) {
    materials_.use(m.front);
    if (m.back != m.front) materials_.use(m.back);
  }
  void operator()(const MaskDescription& m) {
    materials_.use("opacity", m.opacity);
    materials_.use(m.nested);
  }
  void operator()(const BlendDescription& m) {
    materials_.use("weight", m.weight);
    materials_.use(m.first);
    materials_.use(m.second);
  }
  void operator()(const NullDescription&) {}
  void operator()(const BumpMapDescription& m) {
    materials_.use("", m.height);
    xml_.number("scale", m.scale);
    options(m.normal_options);
    materials_.use(m.nested);
  }
  void operator()(const NormalMapDescription& m) {
    materials_.use("normalmap", m.normals);
    options(m.normal_options);
    materials_.use(m.nested);
  }

 private:
  void options(const MappedNormalsDescription& m) {
    xml_.boolean("flip_invalid_normals", m.flip_invalid_normals);
    xml_.boolean("use_shadowing_function", m.use_shadowing_function);
  }
  void conductor(const std::optional<ComplexIor>& ior) {
    if (!ior) return xml_.string("material", "none");
    xml_.rgb("eta", ior->eta);
    xml_.rgb("k", ior->k);
  }
  template <class Model>
  void microfacets(const Model& m) {
    xml_.string("distribution", name_of(m.distribution));
    xml_.boolean("sample_visible", m.sample_visible);
  }
  /// One `alpha` where both are the same: a texture without an id would else be written, and read, twice.
  template <class Model>
  void alphas(const Model& m) {
    if (m.alpha_u == m.alpha_v) return materials_.use("alpha", m.alpha_u);
    materials_.use("alpha_u", m.alpha_u);
    materials_.use("alpha_v", m.alpha_v);
  }
  template <class Model>
  void iors(const Model& m) {
    xml_.number("int_ior", m.int_ior);
    xml_.number("ext_ior", m.ext_ior);
  }
  template <class Model>
  void dielectric(const Model& m) {
    iors(m);
    materials_.use("specular_reflectance", m.specular_reflectance);
    materials_.use("specular_transmittance", m.specular_transmittance);
  }
  template <class Model>
  void plastic(const Model& m) {
    iors(m);
    materials_.use("diffuse_reflectance", m.diffuse_reflectance);
    materials_.use("specular_reflectance", m.specular_reflectance);
    xml_.boolean("nonlinear", m.nonlinear);
  }

  MaterialWriter& materials_;
  XmlWriter& xml_;
};

}  // namespace

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

void MaterialWriter::write(const TextureDescription& texture, const std::string& name) {
  if (const auto* bitmap = std::get_if<BitmapDescription>(&texture.pattern)) {
    xml_.open_plugin("texture", "bitmap", texture.id, name);
    xml_.string("filename", bitmap->filename);
    xml_.boolean("raw", bitmap->raw);
    xml_.string("filter_type", name_of(bitmap->filter));
    xml_.string("wrap_mode", name_of(bitmap->wrap));
    xml_.transform("to_uv", bitmap->to_uv);
  } else {
    const auto& board = std::get<CheckerboardDescription>(texture.pattern);
    xml_.open_plugin("texture", "checkerboard", texture.id, name);
    use("color0", board.color0);
    use("color1", board.color1);
    xml_.transform("to_uv", board.to_uv);
  }
  xml_.close();
}

void MaterialWriter::write(const BsdfDescription& bsdf) {
  std::visit(
      [&](const auto& model) {
        xml_.open_plugin("bsdf", type_of(model), bsdf.id);
        BsdfContent(*this, xml_)(model);
      },
      bsdf.model);
  xml_.close();
}

void MaterialWriter::write(const MediumDescription& medium, const std::string& name) {
  const auto& model = std::get<HomogeneousDescription>(medium.model);
  xml_.open_plugin("medium", "homogeneous", medium.id, name);
  xml_.rgb("sigma_t", model.sigma_t);
  xml_.rgb("albedo", model.albedo);
  xml_.number("scale", model.scale);
  if (const auto* hg = std::get_if<HenyeyGreensteinDescription>(&model.phase)) {
    xml_.open_plugin("phase", "hg", "");
    xml_.number("g", hg->g);
    xml_.close();
  } else {
    xml_.leaf("phase", {{"type", "isotropic"}});
  }
  xml_.close();
}

}  // namespace photonproof
