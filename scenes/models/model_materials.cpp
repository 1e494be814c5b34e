#include "scenes/models/model_materials.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <cmath>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/models/model_files.h"

namespace photonproof::inline scenes_models {
namespace {

namespace fs = std::filesystem;

float number(const aiMaterial& material, const char* key, unsigned type, unsigned index, float fallback) {
  float value = fallback;
  return material.Get(key, type, index, value) == aiReturn_SUCCESS && std::isfinite(value) ? value : fallback;
}

aiColor4D colour_of(const aiMaterial& material, const char* key, unsigned type, unsigned index,
                    const aiColor4D& fallback) {
  aiColor4D value = fallback;
  return material.Get(key, type, index, value) == aiReturn_SUCCESS ? value : fallback;
}

RgbD share(const aiColor4D& c) {
  const auto clamped = [](float v) { return std::clamp(double{v}, 0.0, 1.0); };
  return {clamped(c.r), clamped(c.g), clamped(c.b)};
}

/// glTF's alpha is the square of the roughness.
double alpha_of(float roughness) { return std::max(1e-3, double{roughness} * roughness); }

}  // namespace

std::string ModelMaterials::texture_file(const std::string& name) {
  if (const aiTexture* embedded = model_.GetEmbeddedTexture(name.c_str())) {
    if (embedded->mHeight != 0) throw InputError(name, "an embedded texture without a file format");
    const auto number = static_cast<std::size_t>(
        std::find(model_.mTextures, model_.mTextures + model_.mNumTextures, embedded) - model_.mTextures);
    const std::string hint = embedded->achFormatHint;
    const std::string file = "texture-" + std::to_string(number) + "." + (hint.empty() ? "png" : hint);
    write_file_atomically(scene_folder_ / file, {reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth});
    return file;
  }
  const fs::path source = model_folder_ / fs::path(name), target = scene_folder_ / source.filename();
  std::error_code error;
  if (!allow_outside_) check_inside(source, model_folder_);
  if (!fs::exists(source, error)) throw InputError(source.string(), "no such file");
  if (!fs::equivalent(source, target, error))
    fs::copy_file(source, target, fs::copy_options::overwrite_existing, error);
  if (error && !fs::exists(target)) throw InputError(source.string(), "cannot be copied: " + error.message());
  return source.filename().string();
}

std::optional<TextureIndex> ModelMaterials::texture(const aiMaterial& material,
                                                    std::initializer_list<aiTextureType> types, bool raw) {
  for (const aiTextureType type : types) {
    aiString name;
    if (material.GetTexture(type, 0, &name) != aiReturn_SUCCESS) continue;
    BitmapDescription bitmap;
    try {
      bitmap.filename = texture_file(name.C_Str());
    } catch (const InputError& error) {
      remarks_.insert("a texture is left out: " + error.summary());
      continue;
    }
    bitmap.raw = raw;
    scene_.textures.push_back({{}, "texture-" + std::to_string(scene_.textures.size()), bitmap});
    return TextureIndex{static_cast<std::uint32_t>(scene_.textures.size() - 1)};
  }
  return std::nullopt;
}

Colour ModelMaterials::colour(const aiMaterial& material, const aiColor4D& factor,
                              std::initializer_list<aiTextureType> types) {
  const auto image = texture(material, types, false);
  if (!image) return share(factor);
  if (factor.r != 1 || factor.g != 1 || factor.b != 1)
    remarks_.insert("factors of colours beside a texture are left out");
  return *image;
}

BsdfModel ModelMaterials::model_of(const aiMaterial& material) {
  const aiColor4D white(1, 1, 1, 1);
  float metallic = 0, roughness = 1;
  const bool is_gltf = material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS;
  const double ior = number(material, AI_MATKEY_REFRACTI, 1.5f);
  const double glass_ior = ior > 1 && ior < 100 ? ior : 1.5;
  if (is_gltf) {
    material.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
    const Colour base = colour(material, colour_of(material, AI_MATKEY_BASE_COLOR, white),
                               {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    if (texture(material, {aiTextureType_METALNESS, aiTextureType_DIFFUSE_ROUGHNESS}, true)) {
      scene_.textures.pop_back();
      remarks_.insert("textures of metalness and roughness are left out");
    }
    const double alpha = alpha_of(roughness);
    if (number(material, AI_MATKEY_TRANSMISSION_FACTOR, 0) > 0.5f) {
      if (roughness < 0.05f) return DielectricDescription{.int_ior = glass_ior, .ext_ior = 1};
      return RoughDielectricDescription{.distribution = MicrofacetDistribution::ggx,
                                        .alpha_u = alpha,
                                        .alpha_v = alpha,
                                        .int_ior = glass_ior,
                                        .ext_ior = 1};
    }
    if (metallic >= 0.5f)
      return RoughConductorDescription{.distribution = MicrofacetDistribution::ggx,
                                       .alpha_u = alpha,
                                       .alpha_v = alpha,
                                       .ior = {},
                                       .specular_reflectance = base};
    return RoughPlasticDescription{.distribution = MicrofacetDistribution::ggx,
                                   .alpha = alpha,
                                   .diffuse_reflectance = base,
                                   .int_ior = glass_ior,
                                   .ext_ior = 1};
  }
  if (number(material, AI_MATKEY_OPACITY, 1) < 0.5f && ior > 1)
    return DielectricDescription{.int_ior = glass_ior, .ext_ior = 1};
  const Colour diffuse = colour(material, colour_of(material, AI_MATKEY_COLOR_DIFFUSE, aiColor4D(.5f, .5f, .5f, 1)),
                                {aiTextureType_DIFFUSE});
  const RgbD gloss = share(colour_of(material, AI_MATKEY_COLOR_SPECULAR, aiColor4D(0, 0, 0, 1)));
  const double exponent = number(material, AI_MATKEY_SHININESS, 0);
  if (max_component(gloss) > 0 && exponent > 1)
    return PhongDescription{.exponent = exponent, .diffuse_reflectance = diffuse, .specular_reflectance = gloss};
  return DiffuseDescription{diffuse};
}

BsdfIndex ModelMaterials::add(BsdfModel model, const std::string& id) {
  scene_.bsdfs.push_back({{}, id, std::move(model)});
  return {static_cast<std::uint32_t>(scene_.bsdfs.size() - 1)};
}

BsdfIndex ModelMaterials::bsdf(const aiMaterial& material, const std::string& id) {
  const BsdfModel own = model_of(material);
  const bool opaque = !traits_of({{}, "", own}).transmits;
  BsdfIndex index = add(own, opaque ? id + "-front" : id);
  if (opaque) index = add(TwoSidedDescription{index, index}, id);
  const float opacity = number(material, AI_MATKEY_OPACITY, 1);
  if (opaque && opacity < 1)
    index = add(MaskDescription{.opacity = std::max(0.0, double{opacity}), .nested = index}, id + "-opacity");
  return index;
}

std::optional<Colour> ModelMaterials::emission(const aiMaterial& material) {
  aiColor4D glow(0, 0, 0, 1);
  if (material.Get(AI_MATKEY_COLOR_EMISSIVE, glow) != aiReturn_SUCCESS) return std::nullopt;
  const double strength = number(material, AI_MATKEY_EMISSIVE_INTENSITY, 1);
  const RgbD radiance =
      RgbD(std::max(0.0, double{glow.r}), std::max(0.0, double{glow.g}), std::max(0.0, double{glow.b})) * strength;
  if (max_component(radiance) <= 0) return std::nullopt;
  return radiance;
}

}  // namespace photonproof::inline scenes_models
