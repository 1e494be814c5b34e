#include "scenes/description/scene_hash.h"

#include <algorithm>
#include <type_traits>

#include "scenes/description/scene_volumes.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline scenes_description {
namespace {

class SceneHash {
 public:
  void text(const std::string& s) {
    const std::uint64_t size = s.size();
    checksum_.add(&size, sizeof size);
    checksum_.add(s.data(), s.size());
  }
  template <class T>
  void vector(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::uint64_t size = values.size();
    checksum_.add(&size, sizeof size);
    if (size > 0) checksum_.add(values.data(), values.size() * sizeof(T));
  }
  void asset(const Image& image) {
    text(std::to_string(image.width));
    vector(image.rgb);
  }
  void asset(const TriangleMesh& mesh) {
    vector(mesh.positions);
    vector(mesh.triangles);
    vector(mesh.normals);
    vector(mesh.uvs);
    for (const MeshAttribute& attribute : mesh.attributes) {
      text(attribute.name);
      vector(attribute.values);
    }
  }
  void asset(const VolumeGrid& grid) {
    vector(std::vector<float>{static_cast<float>(grid.width), static_cast<float>(grid.height),
                              static_cast<float>(grid.channels), grid.low.x, grid.low.y, grid.low.z, grid.high.x,
                              grid.high.y, grid.high.z});
    vector(grid.values);
  }
  void asset(const CurveSet& curves) {
    vector(curves.points);
    vector(curves.first);
  }
  void asset(const IesProfile& profile) {
    vector(profile.vertical_degrees);
    vector(profile.horizontal_degrees);
    vector(profile.candela);
  }
  /// Adds the assets of any description that refers to some.
  template <class Description>
  void assets_of(const Description& d) {
    if constexpr (requires { *d.image; })
      if (d.image) asset(*d.image);
    if constexpr (requires { *d.mesh; })
      if (d.mesh) asset(*d.mesh);
    if constexpr (requires { *d.profile; })
      if (d.profile) asset(*d.profile);
    if constexpr (requires { *d.curves; })
      if (d.curves) asset(*d.curves);
    if constexpr (requires { *d.grid; })
      if (d.grid) asset(*d.grid);
  }
  std::string hex() const { return checksum_.hex(); }

 private:
  Checksum checksum_;
};

}  // namespace

std::string scene_hash(const SceneDescription& scene) {
  SceneHash hash;
  std::vector<std::string> defines = scene.defines;
  std::sort(defines.begin(), defines.end());
  for (const std::string& define : defines) hash.text(define);
  for (const std::string& file : scene.files) hash.text(read_file(file));
  const auto add = [&](const auto& description) { hash.assets_of(description); };
  for (const TextureDescription& texture : scene.textures) std::visit(add, texture.pattern);
  for (const ShapeDescription& shape : scene.shapes) std::visit(add, shape.geometry);
  for (const ShapeGroupDescription& group : scene.groups)
    for (const ShapeDescription& shape : group.shapes) std::visit(add, shape.geometry);
  for (const EmitterDescription& emitter : scene.emitters) std::visit(add, emitter.light);
  visit_volumes(scene, add);
  return hash.hex();
}

}  // namespace photonproof::inline scenes_description
