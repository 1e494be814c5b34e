// Every integrator that a scene of scenes/showcase does not declare unsupported renders it, and finds all of its light.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "renderer/api/render_scene.h"
#include "scenes/description/expect.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_api {
namespace {

namespace fs = std::filesystem;

const fs::path kShowcase = fs::path(PHOTONPROOF_SOURCE_DIR) / "scenes/showcase";

/// Light that a scene's page says is not found.
const std::map<std::string, std::string> kStatedLosses = {
    {"foggy-stage", "cannot find light of lights without size that mirrors, glass or clear coats send on"}};

/// Warnings about the number of photons concern so small a render only.
bool is_about_the_budget(const std::string& warning) {
  return warning.find("too few arrive where the camera looks") != std::string::npos;
}

void expect_rendered(const std::string& name, const std::string& integrator) {
  SCOPED_TRACE(name + " by " + integrator);
  const SceneDescription scene =
      parse_scene_file((kShowcase / name / "scene.xml").string(), {{{"width", "16"}, {"height", "12"}}, false});
  const Rendered rendered = render_scene(scene, {.integrator = integrator, .budget = {.spp = 1}});
  const Image& image = rendered.image.mean;
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.height, 12);
  EXPECT_EQ(rendered.non_finite_values, 0u);
  double sum = 0;
  for (const float value : image.rgb) sum += double{value};
  EXPECT_GT(sum, 0) << "the image is black";
  const auto stated = kStatedLosses.find(name);
  std::size_t found = 0;
  for (const std::string& loss : rendered.stats.losses) {
    const bool is_stated = stated != kStatedLosses.end() && loss.find(stated->second) != std::string::npos;
    found += is_stated ? 1 : 0;
    EXPECT_TRUE(is_stated || is_about_the_budget(loss)) << loss;
  }
  EXPECT_EQ(found, stated == kStatedLosses.end() ? 0u : 1u) << "a stated loss that does not occur";
}

TEST(showcase, renders_by_every_integrator_that_is_not_declared_unsupported) {
  int renders = 0;
  for (const auto& entry : fs::directory_iterator(kShowcase)) {
    if (!entry.is_directory()) continue;
    const std::string name = entry.path().filename().string();
    const Expect expect = read_expect(expect_path_of((entry.path() / "scene.xml").string()));
    for (const char* integrator : {"path", "volpath", "bdpt", "photonmapper", "sppm", "ptracer", "direct", "whitted"}) {
      if (expect.unsupported.contains(integrator)) continue;
      expect_rendered(name, integrator);
      ++renders;
    }
  }
  EXPECT_GE(renders, 4 * 5 + 2) << "four scenes by five integrators, two with media by one";
}

}  // namespace
}  // namespace photonproof::inline renderer_api
