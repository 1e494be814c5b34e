#include "scenes/description/file_names.h"

#include <filesystem>
#include <variant>
#include <vector>

#include "scenes/description/scene_volumes.h"

namespace photonproof::inline scenes_description {

void visit_file_names(SceneDescription& scene, const std::function<void(std::string&)>& visit) {
  const auto visit_shape = [&](auto& geometry) {
    if constexpr (requires { geometry.filename; }) visit(geometry.filename);
  };
  const auto visit_shapes = [&](std::vector<ShapeDescription>& shapes) {
    for (ShapeDescription& shape : shapes) std::visit(visit_shape, shape.geometry);
  };
  visit_shapes(scene.shapes);
  for (ShapeGroupDescription& group : scene.groups) visit_shapes(group.shapes);
  for (TextureDescription& texture : scene.textures)
    if (auto* bitmap = std::get_if<BitmapDescription>(&texture.pattern)) visit(bitmap->filename);
  visit_volumes(scene, [&](auto& volume) {
    if constexpr (requires { volume.filename; }) visit(volume.filename);
  });
  for (EmitterDescription& emitter : scene.emitters) {
    if (auto* map = std::get_if<EnvmapDescription>(&emitter.light)) visit(map->filename);
    if (auto* profile = std::get_if<IesLightDescription>(&emitter.light)) visit(profile->filename);
  }
}

SceneDescription with_absolute_files(SceneDescription scene) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::absolute(scene.files.empty() ? fs::path(".") : fs::path(scene.files.front()).parent_path());
  visit_file_names(scene, [&](std::string& name) { name = (folder / name).lexically_normal().string(); });
  return scene;
}

}  // namespace photonproof::inline scenes_description
