// Files of models as Assimp may read them. None lies outside the model's folder, unless that is allowed. Numbers of OBJ
// files begin with a digit: Assimp (5.2) does not count `.5` as one and then finds too few coordinates, but other
// programs write such numbers.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_models {

/// The text with a 0 before the point of numbers that begin with it, in lines of vertices, normals and coordinates of
/// textures.
std::string with_leading_zeros(std::string_view obj);

/// Throws InputError if the file is not below the folder, after links.
void check_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

class ModelFiles : public Assimp::DefaultIOSystem {
 public:
  ModelFiles(std::filesystem::path folder, bool allow_outside)
      : folder_(std::move(folder)), allow_outside_(allow_outside) {}
  Assimp::IOStream* Open(const char* file, const char* mode = "rb") override;

 private:
  std::filesystem::path folder_;
  bool allow_outside_;
};

}  // namespace photonproof::inline scenes_models
