// How `photonproof cycles` and `export -o x.py` end, with programs in Blender's place.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

namespace fs = std::filesystem;

class VerbCycles : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void put_blender(const std::string& script) const {
    fs::create_directories(folder_ / "bin");
    put("bin/blender", "#!/bin/sh\nfor last; do :; done\nimages=$(dirname \"$last\")\n" + script + "\n");
    fs::permissions(folder_ / "bin/blender", fs::perms::owner_all);
  }

  /// `photonproof cycles`, which finds only what `put_blender` put there, and the tools that scripts need.
  ProcessOutcome cycles(const std::string& bsdf = "diffuse", const std::string& search = ":/usr/bin:/bin") const {
    put("scene.xml",
        "<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><integer name='width' "
        "value='4'/><integer name='height' value='4'/><rfilter type='box'/></film></sensor><emitter "
        "type='constant'/><shape type='sphere'><bsdf type='" +
            bsdf + "'/></shape></scene>");
    return run_process({"/usr/bin/env", "PATH=" + path("bin") + search, PHOTONPROOF_BINARY, "cycles", path("scene.xml"),
                        "-o", path("out.exr"), "--spp", "3", "--seed", "5", "--json"});
  }

  void expect_end(const ProcessOutcome& outcome, int exit_code, const std::string& message) const {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.standard_error;
    EXPECT_EQ(last_line(outcome.standard_error), message);
    EXPECT_FALSE(has("out.exr"));
    EXPECT_FALSE(has("out.stats.json"));
  }
};

TEST_F(VerbCycles, writes_an_image_and_its_stats) {
  Rendering rendering;
  rendering.mean = Image(4, 4);
  write_exr(path("black.exr"), rendering);
  put_blender("echo 'Blender 9.9'; cp '" + path("black.exr") + "' \"$images/batch_0.exr\"");
  const ProcessOutcome outcome = cycles();
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  const auto stats = nlohmann::json::parse(get("out.stats.json"));
  EXPECT_EQ(stats.at("engine"), "cycles");
  EXPECT_EQ(stats.at("version"), "Blender 9.9");
  EXPECT_EQ(stats.at("samples_per_pixel"), 3);
  EXPECT_EQ(stats.at("seed"), 5);
  EXPECT_EQ(read_image(path("out.exr")).width, 4);
}

TEST_F(VerbCycles, without_blender_is_told_what_to_install) {
  expect_end(
      cycles("diffuse", ""), 2,
      "blender: error: Blender cannot be run ('blender': No such file or directory); on Debian: apt install blender");
}

TEST_F(VerbCycles, killed_blender_leaves_nothing) {
  put_blender("kill -9 $$");
  expect_end(cycles(), 70, "Blender killed by SIGKILL: nothing was written");
}

TEST_F(VerbCycles, broken_image_leaves_nothing) {
  put_blender("echo broken > \"$images/batch_0.exr\"");
  const ProcessOutcome outcome = cycles();
  EXPECT_EQ(outcome.exit_code, 70);
  EXPECT_NE(outcome.standard_error.find("Blender ended well and left an image that cannot be read"), std::string::npos)
      << outcome.standard_error;
  EXPECT_FALSE(has("out.exr"));
}

TEST_F(VerbCycles, refuses_with_3_before_blender_is_started) {
  put_blender("touch '" + path("started") + "'; exit 1");
  expect_end(cycles("roughplastic"), 3,
             path("scene.xml") +
                 ":1:223: error: not representable in Cycles: a rough plastic: light enters its coat by the light's "
                 "direction, and the colour of Cycles' diffuse reflection depends on the viewer's alone");
  EXPECT_FALSE(has("started"));
}

TEST_F(VerbCycles, export_writes_the_script_where_the_name_ends_so) {
  cycles();
  const ProcessOutcome outcome = run_process({PHOTONPROOF_BINARY, "export", path("scene.xml"), "-o", path("mine.py")});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_NE(
      outcome.standard_output.find("blender -b --factory-startup --python-exit-code 1 --python " + path("mine.py")),
      std::string::npos);
  EXPECT_NE(get("mine.py").find("\nshape(\"shape_0\", form(\"sphere\""), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_engines
