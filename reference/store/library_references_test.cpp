// The references committed in the scene library: complete, up to date with their scenes, and with the known means.

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "reference/store/reference_store.h"
#include "scenes/description/expect.h"

namespace photonproof::inline reference_store {
namespace {

namespace fs = std::filesystem;

struct Committed {
  fs::path scene;
  int width, height;
};

std::vector<Committed> committed_references() {
  std::vector<Committed> found;
  const std::regex name("reference-([0-9]+)x([0-9]+)\\.(exr|json)");
  for (const auto& scene : fs::directory_iterator(PHOTONPROOF_SOURCE_DIR "/scenes/library"))
    for (const auto& file : fs::directory_iterator(scene)) {
      std::smatch size;
      const std::string text = file.path().filename().string();
      if (std::regex_match(text, size, name) && size[3] == "json")
        found.push_back({scene.path() / "scene.xml", std::stoi(size[1]), std::stoi(size[2])});
    }
  return found;
}

TEST(LibraryReferences, every_one_is_whole_and_of_its_scenes_present_content) {
  EXPECT_GE(committed_references().size(), 10u);  // of the scenes of harness/suites/gates.toml
  for (const Committed& c : committed_references()) {
    const StoredReference stored = load_reference(c.scene, c.width, c.height);  // throws what is wrong
    EXPECT_EQ(stored.file.parent_path(), c.scene.parent_path());
    EXPECT_NEAR(relative_standard_error(stored.rendering), stored.provenance.standard_error,
                1e-12 * stored.provenance.standard_error);
    EXPECT_GE(stored.provenance.seeds.size(), 32u) << c.scene;
    EXPECT_LT(stored.provenance.standard_error, 0.01) << c.scene;  // a gate's image of 16 samples has 0.1 and more
  }
}

TEST(LibraryReferences, means_are_the_closed_forms) {
  int known = 0;
  for (const Committed& c : committed_references()) {
    const Expect expect = read_expect(expect_path_of(c.scene.string()));
    if (!expect.analytic || !expect.analytic->mean) continue;
    ++known;
    const Rendering r = load_reference(c.scene, c.width, c.height).rendering;
    const double stated[3] = {expect.analytic->mean->x, expect.analytic->mean->y, expect.analytic->mean->z};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      double sum = 0, variance = 0;
      for (std::size_t i = channel; i < r.mean.rgb.size(); i += 3) {
        sum += r.mean.rgb[i];
        variance += r.variance->rgb[i];
      }
      const auto pixels = static_cast<double>(r.mean.pixels());
      // 4 standard errors of the mean, and the 6 digits the scene states.
      const double bound = 4 * std::sqrt(variance) / pixels + 1e-5 * stated[channel];
      EXPECT_NEAR(sum / pixels, stated[channel], bound) << c.scene << " channel " << channel;
    }
  }
  EXPECT_GE(known, 4);  // furnace, light-area, light-envmap, light-point
}

}  // namespace
}  // namespace photonproof::inline reference_store
