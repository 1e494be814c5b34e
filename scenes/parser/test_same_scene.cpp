#include "scenes/parser/test_same_scene.h"

#include <algorithm>

namespace photonproof::inline scenes_parser {
namespace {

std::string difference(const TextureDescription& a, const TextureDescription& b) {
  if (a.id != b.id) return ".id";
  return a.pattern == b.pattern ? "" : ".pattern";
}

std::string difference(const MediumDescription& a, const MediumDescription& b) {
  if (a.id != b.id) return ".id";
  return a.model == b.model ? "" : ".model";
}

std::string difference(const BsdfDescription& a, const BsdfDescription& b) {
  if (a.id != b.id) return ".id";
  return a.model == b.model ? "" : ".model";
}

std::string difference(const ShapeDescription& a, const ShapeDescription& b) {
  if (a.id != b.id) return ".id";
  if (a.geometry != b.geometry) return ".geometry";
  if (a.to_world != b.to_world) return ".to_world";
  if (a.flip_normals != b.flip_normals) return ".flip_normals";
  if (a.bsdf != b.bsdf) return ".bsdf";
  if (a.measures != b.measures) return ".measures";
  if (a.emits_along_normal != b.emits_along_normal) return ".emits_along_normal";
  if (a.interior != b.interior) return ".interior";
  if (a.exterior != b.exterior) return ".exterior";
  return a.radiance == b.radiance ? "" : ".radiance";
}

std::string difference(const EmitterDescription& a, const EmitterDescription& b) {
  if (a.id != b.id) return ".id";
  return a.light == b.light ? "" : ".light";
}

std::string difference(const SensorDescription& a, const SensorDescription& b) {
  if (a.id != b.id) return ".id";
  if (a.camera != b.camera) return ".camera";
  if (a.to_world != b.to_world) return ".to_world";
  if (a.film != b.film) return ".film";
  if (a.medium != b.medium) return ".medium";
  return a.sample_count == b.sample_count ? "" : ".sample_count";
}

std::string difference(const ShapeGroupDescription& a, const ShapeGroupDescription& b);

template <class Entity>
std::string difference(const std::string& name, const std::vector<Entity>& a, const std::vector<Entity>& b) {
  if (a.size() != b.size()) return name + ".size()";
  std::string inner;
  std::size_t i = 0;
  while (i < a.size() && inner.empty()) {
    inner = difference(a[i], b[i]);
    ++i;
  }
  return inner.empty() ? "" : name + "[" + std::to_string(i - 1) + "]" + inner;
}

std::string difference(const ShapeGroupDescription& a, const ShapeGroupDescription& b) {
  return a.id != b.id ? ".id" : difference(".shapes", a.shapes, b.shapes);
}

}  // namespace

std::string first_difference(const SceneDescription& a, const SceneDescription& b) {
  for (const std::string& found :
       {difference("textures", a.textures, b.textures), difference("media", a.media, b.media),
        difference("bsdfs", a.bsdfs, b.bsdfs), difference("groups", a.groups, b.groups),
        difference("shapes", a.shapes, b.shapes), difference("emitters", a.emitters, b.emitters)})
    if (!found.empty()) return found;
  if (const std::string inner = difference(a.sensor, b.sensor); !inner.empty()) return "sensor" + inner;
  return a.integrator.method == b.integrator.method ? "" : "integrator.method";
}

}  // namespace photonproof::inline scenes_parser
