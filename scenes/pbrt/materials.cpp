#include "scenes/pbrt/materials.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/text_numbers.h"
#include "scenes/curves/hair_colour.h"
#include "scenes/description/named_ior.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_pbrt {

using Use = PbrtTextures::Use;

BsdfIndex PbrtMaterials::add(Model model) {
  std::vector<BsdfDescription>& bsdfs = context_.scene.bsdfs;
  bsdfs.push_back({{}, "material-" + std::to_string(bsdfs.size()), std::move(model)});
  return {static_cast<std::uint32_t>(bsdfs.size() - 1)};
}

BsdfIndex PbrtMaterials::add_two_sided(Model model) {
  const BsdfIndex front = add(std::move(model));
  return add(TwoSidedDescription{front, front});
}

PbrtMaterials::Made PbrtMaterials::made(const PbrtState& state, const PbrtParameters& shape) {
  PbrtEntityPtr material = state.material;
  if (!state.named_material.empty()) {
    const auto found = named_.find(state.named_material);
    if (found == named_.end())
      shape.fail("has the material " + in_quotes(state.named_material) + ", which is not defined");
    material = found->second;
  }
  return made(material, 0);
}

PbrtMaterials::Made PbrtMaterials::made(const PbrtEntityPtr& material, int depth) {
  if (const auto known = made_.find(material); known != made_.end()) return known->second;
  if (!material) return made_[material] = {add_two_sided(DiffuseDescription{}), false};
  // A material that cannot be read is told once, and its shapes are grey.
  Made result;
  bool is_read = false;
  context_.log.attempt([&] {
    result = made_new(*material, depth);
    is_read = true;
  });
  if (!is_read) result = {add_two_sided(DiffuseDescription{}), false};
  return made_[material] = result;
}

PbrtMaterials::Made PbrtMaterials::made_new(const PbrtEntity& material, int depth) {
  const PbrtParameters& p = material.parameters;
  Made result;
  if (material.type == "mix") {
    result = mix(p, depth);
  } else {
    result.bsdf = with_relief(model_of(material), p);
    for (const PbrtParameter& parameter : p.all())
      result.textured = result.textured || parameter.type == "texture" || parameter.name == "normalmap";
  }
  p.finish();
  return result;
}

BsdfIndex PbrtMaterials::model_of(const PbrtEntity& material) {
  const PbrtParameters& p = material.parameters;
  if (material.type == "diffuse")
    return add_two_sided(DiffuseDescription{textures_.colour(p, "reflectance", RgbD(0.5), Use::share)});
  if (material.type == "coateddiffuse") return coated_diffuse(p);
  if (material.type == "conductor") return conductor(p, "", true);
  if (material.type == "coatedconductor") return coated_conductor(p);
  if (material.type == "dielectric") return dielectric(p);
  if (material.type == "thindielectric")
    return add(ThinDielectricDescription{context_.spectra.index(p, "eta", 1.5), 1});
  if (material.type == "diffusetransmission") return sheet(p);
  if (material.type == "interface" || material.type == "none" || material.type.empty()) return add(NullDescription{});
  if (material.type == "hair") return hair(p);
  if (material.type == "subsurface") {
    context_.log.note(p.at(), "material 'subsurface' is rendered as plastic: light does not travel below the surface");
    p.ignore({"sigma_a", "sigma_s", "mfp", "g", "scale", "name"});
    return coated_diffuse(p);
  }
  p.fail(
      "is not supported, expected diffuse, coateddiffuse, conductor, coatedconductor, dielectric, thindielectric, "
      "diffusetransmission, mix, hair, subsurface or interface");
}

BsdfIndex PbrtMaterials::hair(const PbrtParameters& p) {
  context_.log.note(
      p.at(),
      "material 'hair' is rendered as principled: it has the colour of a full head of hair, without light "
      "through hairs");
  p.ignore({"eta", "alpha"});
  const double along = p.number("beta_m", 0.3, 0, 1), around = p.number("beta_n", 0.3, 0, 1);
  PrincipledDescription model;
  model.roughness = along;
  const char* const name = p.has("reflectance") ? "reflectance" : "color";
  if (p.has(name)) {
    model.base_color = textures_.colour(p, name, RgbD(0.5), Use::share);
    return add_two_sided(std::move(model));
  }
  std::optional<RgbD> absorption = context_.spectra.colour(p, "sigma_a");
  const double eumelanin = p.number("eumelanin", p.has("pheomelanin") ? 0 : 1.3, 0, 1e30);
  if (!absorption) absorption = absorption_of_pigments(eumelanin, p.number("pheomelanin", 0, 0, 1e30));
  model.base_color = colour_of_hair(*absorption, around);
  return add_two_sided(std::move(model));
}

PbrtMaterials::Roughness PbrtMaterials::roughness(const PbrtParameters& p, const std::string& prefix) {
  const Use use = p.boolean("remaproughness", true) ? Use::root : Use::number;
  const auto along = [&](const std::string& name) {
    return textures_.number(p, p.has(prefix + name) ? prefix + name : prefix + "roughness", 0, use);
  };
  Roughness result{along("uroughness"), along("vroughness"), false};
  // pbrt's limit of the smooth, in alpha.
  const auto is_smooth = [](const Scalar& alpha) {
    const double* value = std::get_if<double>(&alpha);
    return value != nullptr && *value <= 1e-3;
  };
  result.smooth = is_smooth(result.u) && is_smooth(result.v);
  for (Scalar* alpha : {&result.u, &result.v})
    if (double* value = std::get_if<double>(alpha)) *value = std::max(*value, 1e-3);
  return result;
}

void PbrtMaterials::fail_unless_constant(const PbrtParameters& p, const Scalar& number) const {
  if (!std::holds_alternative<double>(number)) p.fail("has a texture of its roughness, expected a number");
}

BsdfIndex PbrtMaterials::coated_diffuse(const PbrtParameters& p) {
  p.ignore({"maxdepth", "nsamples", "twosided", "thickness", "albedo", "g"});
  if (p.has("albedo")) context_.log.note(p.at(), "coats do not scatter light: 'albedo' and 'g' are left out");
  const Roughness rough = roughness(p, "");
  const Colour reflectance = textures_.colour(p, "reflectance", RgbD(0.5), Use::share);
  const double eta = context_.spectra.index(p, "eta", 1.5);
  context_.log.note(p.at(),
                    "material 'coateddiffuse' is rendered as plastic: light between coat and base is in closed form");
  if (rough.smooth)
    return add_two_sided(
        PlasticDescription{.diffuse_reflectance = reflectance, .int_ior = eta, .ext_ior = 1, .nonlinear = true});
  fail_unless_constant(p, rough.u);
  fail_unless_constant(p, rough.v);
  // One alpha of the same area of the ellipse.
  const double alpha = std::sqrt(std::get<double>(rough.u) * std::get<double>(rough.v));
  return add_two_sided(RoughPlasticDescription{.distribution = MicrofacetDistribution::ggx,
                                               .alpha = alpha,
                                               .diffuse_reflectance = reflectance,
                                               .int_ior = eta,
                                               .ext_ior = 1,
                                               .nonlinear = true});
}

BsdfIndex PbrtMaterials::conductor(const PbrtParameters& p, const std::string& prefix, bool two_sided) {
  const Roughness rough = roughness(p, prefix);
  ComplexIor ior;
  Colour mirrored = RgbD(1.0);
  std::optional<ComplexIor> used;
  if (p.has(prefix + "reflectance")) {
    mirrored = textures_.colour(p, prefix + "reflectance", RgbD(1.0), Use::share);
    if (const RgbD* r = std::get_if<RgbD>(&mirrored)) {
      // The k with this reflectance at normal incidence where eta is 1.
      const auto k = [](double share) {
        const double most = std::min(share, 0.9999);
        return 2 * std::sqrt(most) / std::sqrt(1 - most);
      };
      used = ComplexIor{RgbD(1.0), {k(r->x), k(r->y), k(r->z)}};
      mirrored = RgbD(1.0);
    } else {
      context_.log.note(p.at(), "a conductor with a texture mirrors it alike at all angles");
    }
  } else {
    const std::optional<ComplexIor> copper = conductor_named("Cu");
    used = ComplexIor{context_.spectra.metal(p, prefix + "eta", false).value_or(copper->eta),
                      context_.spectra.metal(p, prefix + "k", true).value_or(copper->k)};
  }
  Model model;
  if (rough.smooth)
    model = ConductorDescription{used, mirrored};
  else
    model = RoughConductorDescription{.distribution = MicrofacetDistribution::ggx,
                                      .alpha_u = rough.u,
                                      .alpha_v = rough.v,
                                      .ior = used,
                                      .specular_reflectance = mirrored};
  return two_sided ? add_two_sided(model) : add(model);
}

BsdfIndex PbrtMaterials::coated_conductor(const PbrtParameters& p) {
  p.ignore({"maxdepth", "nsamples", "twosided", "thickness", "albedo", "g"});
  if (p.has("albedo")) context_.log.note(p.at(), "coats do not scatter light: 'albedo' and 'g' are left out");
  if (!roughness(p, "interface.").smooth)
    context_.log.note(p.at(),
                      "material 'coatedconductor' has a smooth coat: the roughness of its interface is left out");
  const BsdfIndex base = conductor(p, "conductor.", false);
  return add_two_sided(
      LayeredDescription{.base = base, .int_ior = context_.spectra.index(p, "interface.eta", 1.5), .ext_ior = 1});
}

BsdfIndex PbrtMaterials::dielectric(const PbrtParameters& p) {
  const Roughness rough = roughness(p, "");
  const double eta = context_.spectra.index(p, "eta", 1.5);
  if (rough.smooth) return add(DielectricDescription{.int_ior = eta, .ext_ior = 1});
  return add(RoughDielectricDescription{.distribution = MicrofacetDistribution::ggx,
                                        .alpha_u = rough.u,
                                        .alpha_v = rough.v,
                                        .int_ior = eta,
                                        .ext_ior = 1});
}

/// A mixture: the shares of both parts are such that neither of them exceeds 1.
BsdfIndex PbrtMaterials::sheet(const PbrtParameters& p) {
  const double scale = p.number("scale", 1, 0, 1e30);
  const bool is_textured = p.find("reflectance", {"texture"}) || p.find("transmittance", {"texture"});
  double passes = 0.5;
  if (!is_textured) {
    const double r = max_component(constant(textures_.colour(p, "reflectance", RgbD(0.25), Use::share, scale)));
    const double t = max_component(constant(textures_.colour(p, "transmittance", RgbD(0.25), Use::share, scale)));
    if (r + t > 0) passes = t / (r + t);
  } else {
    context_.log.note(p.at(),
                      "material 'diffusetransmission' with textures reflects and transmits at most a half each");
  }
  const double front = passes < 1 ? scale / (1 - passes) : 0, back = passes > 0 ? scale / passes : 0;
  const BsdfIndex reflects =
      add_two_sided(DiffuseDescription{textures_.colour(p, "reflectance", RgbD(0.25), Use::share, front)});
  const BsdfIndex transmits =
      add(DiffuseTransmitterDescription{textures_.colour(p, "transmittance", RgbD(0.25), Use::share, back)});
  if (passes <= 0) return reflects;
  if (passes >= 1) return transmits;
  return add(BlendDescription{.weight = passes, .first = reflects, .second = transmits});
}

PbrtMaterials::Made PbrtMaterials::mix(const PbrtParameters& p, int depth) {
  const PbrtParameter* names = p.find("materials", {"string"});
  if (names == nullptr || names->strings.size() != 2) p.fail("expected two names as \"string materials\"");
  constexpr int deepest = 16;
  Made parts[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto found = named_.find(names->strings[i]);
    if (found == named_.end() || depth > deepest)
      p.fail(*names, "has the material " + in_quotes(names->strings[i]) + ", which is not defined");
    parts[i] = made(found->second, depth + 1);
  }
  const bool textured = p.find("amount", {"texture"}) != nullptr;
  return {add(BlendDescription{textures_.number(p, "amount", 0.5, Use::share), parts[0].bsdf, parts[1].bsdf}),
          parts[0].textured || parts[1].textured || textured};
}

BsdfIndex PbrtMaterials::with_relief(BsdfIndex bsdf, const PbrtParameters& p) {
  if (const PbrtParameter* file = p.find("normalmap", {"string"}))
    return add(NormalMapDescription{normal_map(p, *file), bsdf});
  if (!p.has("displacement")) return bsdf;
  const Scalar height = textures_.number(p, "displacement", 0, Use::number);
  const TextureIndex* texture = std::get_if<TextureIndex>(&height);
  return texture == nullptr ? bsdf : add(BumpMapDescription{.height = *texture, .scale = 1, .nested = bsdf});
}

/// In a mirrored world n x dp/du is mirrored, too, so the image's green is turned over.
TextureIndex PbrtMaterials::normal_map(const PbrtParameters& p, const PbrtParameter& file) {
  if (file.strings.size() != 1) p.fail(file, "expected one string");
  const std::filesystem::path path = context_.files.find(file.strings[0], file.at);
  if (context_.to_ours.determinant() > 0) return textures_.image(path, true, RgbD(1.0));
  Rendering turned;
  turned.mean = read_texture_image(path.string(), true);
  for (std::size_t i = 1; i < turned.mean.rgb.size(); i += 3)
    turned.mean.rgb[i] = std::max(0.0f, 1 - turned.mean.rgb[i]);
  return textures_.image(turned, path.stem().string());
}

PbrtMaterials::Made PbrtMaterials::masked(Made material, const PbrtParameters& shape) {
  if (!shape.has("alpha")) return material;
  const Scalar alpha = textures_.number(shape, "alpha", 1, Use::share);
  if (const double* value = std::get_if<double>(&alpha); value != nullptr && *value >= 1) return material;
  return {add(MaskDescription{alpha, material.bsdf}), material.textured || std::holds_alternative<TextureIndex>(alpha)};
}

}  // namespace photonproof::inline scenes_pbrt
