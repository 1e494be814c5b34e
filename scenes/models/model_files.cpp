#include "scenes/models/model_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/inside_folder.h"

namespace photonproof::inline scenes_models {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string with_leading_zeros(std::string_view obj) {
  std::string text;
  text.reserve(obj.size() + obj.size() / 16);
  bool of_vertex = false;
  char last = '\n';
  for (std::size_t i = 0; i < obj.size(); ++i) {
    const char c = obj[i];
    if (last == '\n') of_vertex = c == 'v';
    if (of_vertex && c == '.' && is_blank(last) && i + 1 < obj.size() && is_digit(obj[i + 1])) text += '0';
    text += c;
    last = c;
  }
  return text;
}

void check_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path real = real_path(file, error);
  if (error || !is_inside(real, folder))
    throw InputError(file.string(), "is outside the model's folder (--allow-outside reads it)");
}

Assimp::IOStream* ModelFiles::Open(const char* file, const char* mode) {
  if (!allow_outside_) check_inside(file, folder_);
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending != ".obj" && ending != ".OBJ") return DefaultIOSystem::Open(file, mode);
  const std::string text = with_leading_zeros(read_file(file, std::numeric_limits<std::size_t>::max()));
  auto bytes = std::make_unique<uint8_t[]>(text.size());
  std::ranges::copy(text, bytes.get());
  return new Assimp::MemoryIOStream(bytes.release(), text.size(), true);
}

}  // namespace photonproof::inline scenes_models
