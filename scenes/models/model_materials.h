// Materials of model files as BSDFs.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_models {

using BsdfModel = decltype(BsdfDescription::model);

/// Turns materials into entries of a description's tables, and copies the textures that they name.
class ModelMaterials {
 public:
  ModelMaterials(const aiScene& model, const std::filesystem::path& model_folder,
                 const std::filesystem::path& scene_folder, bool allow_outside, SceneDescription& scene,
                 std::set<std::string>& remarks)
      : model_(model),
        model_folder_(model_folder),
        scene_folder_(scene_folder),
        allow_outside_(allow_outside),
        scene_(scene),
        remarks_(remarks) {}

  /// Metallic-roughness materials of glTF become a rough conductor, a rough plastic or glass; those of MTL a Phong or
  /// diffuse BSDF, or glass. Sides are alike unless light passes.
  BsdfIndex bsdf(const aiMaterial& material, const std::string& id);
  /// The radiance of a material that glows.
  static std::optional<Colour> emission(const aiMaterial& material);

 private:
  BsdfModel model_of(const aiMaterial& material);
  Colour colour(const aiMaterial& material, const aiColor4D& factor, std::initializer_list<aiTextureType> types);
  std::optional<TextureIndex> texture(const aiMaterial& material, std::initializer_list<aiTextureType> types, bool raw);
  std::string texture_file(const std::string& name);
  BsdfIndex add(BsdfModel model, const std::string& id);

  const aiScene& model_;
  std::filesystem::path model_folder_, scene_folder_;
  bool allow_outside_;
  SceneDescription& scene_;
  std::set<std::string>& remarks_;
};

}  // namespace photonproof::inline scenes_models
