#include "scenes/description/output_files.h"

#include <unistd.h>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_description {
namespace {

namespace fs = std::filesystem;

void make_writable(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(file.string(), "folder '" + folder.string() + "' cannot be made: " + error.message());
  check_replaceable(file);
  if (access(folder.c_str(), W_OK) != 0)
    throw InputError(file.string(), "folder '" + folder.string() + "' is not writable");
}

}  // namespace

std::vector<InputFile> scene_inputs(const SceneDescription& scene) {
  std::vector<InputFile> inputs;
  for (const std::string& file : scene.files)
    inputs.push_back({file, inputs.empty() ? "the scene itself" : "a part of the scene"});
  const fs::path folder = scene.files.empty() ? fs::path() : fs::path(scene.files.front()).parent_path();
  const auto add = [&](const auto& kind) {
    std::visit(
        [&](const auto& description) {
          if constexpr (requires { description.filename; })
            inputs.push_back({folder / description.filename, "a file that the scene uses"});
        },
        kind);
  };
  for (const TextureDescription& texture : scene.textures) add(texture.pattern);
  for (const ShapeDescription& shape : scene.shapes) add(shape.geometry);
  for (const ShapeGroupDescription& group : scene.groups)
    for (const ShapeDescription& shape : group.shapes) add(shape.geometry);
  for (const EmitterDescription& emitter : scene.emitters) add(emitter.light);
  return inputs;
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code unresolved, neither_exists;
  const fs::path real_a = fs::weakly_canonical(fs::absolute(a), unresolved);
  if (unresolved) return false;
  const fs::path real_b = fs::weakly_canonical(fs::absolute(b), unresolved);
  return (!unresolved && real_a == real_b) || fs::equivalent(a, b, neither_exists);
}

void prepare_outputs(const std::vector<fs::path>& outputs, const std::vector<InputFile>& inputs) {
  for (const fs::path& output : outputs) {
    make_writable(output);
    for (const InputFile& input : inputs)
      if (same_file(output, input.file))
        throw InputError(output.string(), "is " + input.what + ", which it would replace");
  }
}

}  // namespace photonproof::inline scenes_description
