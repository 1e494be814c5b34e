#include "harness/stress/soak/soak_scenes.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "harness/stress/stress_scene.h"
#include "scenes/files/atomic_file.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_stress_soak {
namespace {

namespace fs = std::filesystem;

/// The features of the stress test that together need every kind of table and hierarchy.
constexpr std::array wanted{"light mesh", "bsdf dielectric", "texture bitmap", "light envmap", "medium homogeneous"};

}  // namespace

std::vector<SoakScene> write_soak_scenes(const fs::path& folder) {
  const std::vector<NamedScene> features = scenes_of_features(folder);
  std::vector<SoakScene> scenes;
  for (const std::string name : wanted) {
    const auto found = std::find_if(features.begin(), features.end(),
                                    [&](const NamedScene& feature) { return feature.first == name; });
    if (found == features.end()) throw std::logic_error("no feature of the stress test is called " + name);
    std::string file = name + ".xml";
    std::replace(file.begin(), file.end(), ' ', '-');
    write_file_atomically(folder / file, write_scene(found->second));
    scenes.push_back({name, folder / file});
  }
  return scenes;
}

}  // namespace photonproof::inline harness_stress_soak
