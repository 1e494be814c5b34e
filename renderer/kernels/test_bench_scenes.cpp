#include "renderer/kernels/test_bench_scenes.h"

#include <filesystem>
#include <map>
#include <random>

#include "renderer/planning/test_compiled.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/generators/million.h"
#include "scenes/parser/parser.h"

namespace photonproof::bench {
namespace {

constexpr int image_size = 256;

SceneDescription load(const std::string& name) {
  const std::string generated = "million:";
  if (name.rfind(generated, 0) != 0)
    return parse_scene_file(std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/library/" + name + "/scene.xml");
  const std::string count = name.substr(generated.size());
  const ScratchFolder folder("bench-scene");
  write_million(folder.path(), plan_million(std::stoull(count)));
  return parse_scene_file((folder.path() / "scene.xml").string());
}

SkipSwitches switches(bool embree) { return embree ? SkipSwitches({"bvh"}) : SkipSwitches(); }

}  // namespace

const Scene& scene(const std::string& name, bool embree) {
  static std::map<std::pair<std::string, bool>, std::unique_ptr<Scene>> scenes;
  std::unique_ptr<Scene>& entry = scenes[{name, embree}];
  if (entry == nullptr) entry.reset(new Scene(test::compiled(load(name), image_size, image_size, switches(embree))));
  return *entry;
}

std::unique_ptr<Scene> random_plates(int count, bool embree) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  SceneDescription description;
  description.bsdfs.push_back({{}, "", DiffuseDescription{}});
  for (int i = 0; i < count; ++i) {
    ShapeDescription shape;
    shape.geometry = RectangleDescription{};
    const auto place = [&] { return Vec3d(uniform(generator), uniform(generator), uniform(generator)); };
    const Vec3d axis = place();
    shape.to_world = Transform::translate(place()) * Transform::rotate(axis, 180 * uniform(generator)) *
                     Transform::scale(Vec3d(0.3));
    description.shapes.push_back(shape);
  }
  description.sensor.camera = PerspectiveDescription{};
  constexpr std::size_t any_number = std::size_t(1) << 20;
  return std::unique_ptr<Scene>(
      new Scene(test::compiled(description, image_size, image_size, switches(embree), any_number)));
}

}  // namespace photonproof::bench
