// Numbers of OBJ files as Assimp takes them. Its reader of OBJ (5.2) does not count `.5` as a number and then finds too
// few coordinates; other programs write such numbers.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <string>
#include <string_view>

namespace photonproof::inline scenes_models {

/// The text with a 0 before the point of numbers that begin with it, in lines of vertices, normals and coordinates of
/// textures.
std::string with_leading_zeros(std::string_view obj);

/// Files as they are, but OBJ files with leading zeros.
class ModelFiles : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode = "rb") override;
};

}  // namespace photonproof::inline scenes_models
