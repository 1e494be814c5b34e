// How `photonproof mitsuba` and `export --for mitsuba` end, with programs in the place of Mitsuba's Python.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

namespace fs = std::filesystem;

class VerbMitsuba : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void put_python(const std::string& script) const {
    put("python", "#!/bin/sh\n" + script + "\n");
    fs::permissions(folder_ / "python", fs::perms::owner_all);
  }

  void put_scene(const std::string& bsdf = "diffuse") const {
    put("scene.xml",
        "<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><integer name='width' "
        "value='4'/><integer name='height' value='4'/><rfilter type='box'/></film></sensor><emitter "
        "type='constant'/><shape type='sphere'><bsdf type='" +
            bsdf + "'/></shape></scene>");
  }

  ProcessOutcome mitsuba(const std::string& bsdf = "diffuse") const {
    put_scene(bsdf);
    return run_process({"/usr/bin/env", "PHOTONPROOF_MITSUBA_PYTHON=" + path("python"), PHOTONPROOF_BINARY, "mitsuba",
                        path("scene.xml"), "-o", path("out.exr"), "--spp", "3", "--seed", "5", "--json"});
  }

  void expect_end(const ProcessOutcome& outcome, int exit_code, const std::string& message) const {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.standard_error;
    EXPECT_EQ(last_line(outcome.standard_error), message);
    EXPECT_FALSE(has("out.exr"));
    EXPECT_FALSE(has("out.stats.json"));
  }
};

TEST_F(VerbMitsuba, writes_an_image_and_its_stats) {
  Rendering rendering;
  rendering.mean = Image(4, 4);
  write_exr(path("black.exr"), rendering);
  put_python("cp '" + path("black.exr") +
             "' batch_0.exr; echo '{\"version\": \"Mitsuba 9.9\", \"variant\": \"scalar_rgb\", \"import_seconds\": 1, "
             "\"load_seconds\": 2, \"compile_seconds\": 3, \"render_seconds\": 4}' > engine.json");
  const ProcessOutcome outcome = mitsuba();
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  const auto stats = nlohmann::json::parse(get("out.stats.json"));
  EXPECT_EQ(stats.at("engine"), "mitsuba");
  EXPECT_EQ(stats.at("version"), "Mitsuba 9.9");
  EXPECT_EQ(stats.at("variant"), "scalar_rgb");
  EXPECT_EQ(stats.at("samples_per_pixel"), 3);
  EXPECT_EQ(stats.at("seed"), 5);
  EXPECT_EQ(stats.at("compile_seconds"), 3);
  EXPECT_EQ(read_image(path("out.exr")).width, 4);
}

TEST_F(VerbMitsuba, a_python_that_is_not_there_is_bad_input) {
  expect_end(mitsuba(), 2,
             path("python") + ": error: the Python that has Mitsuba cannot be run ('" + path("python") +
                 "': No such file or directory)");
}

// A copy of the program in a tree without build/peers, and no python3 on PATH.
TEST_F(VerbMitsuba, without_mitsuba_ends_with_3_and_what_to_do) {
  put_scene();
  fs::copy_file(PHOTONPROOF_BINARY, path("photonproof"));
  fs::create_directories(path("empty"));
  const std::string message =
      "Mitsuba is not installed: './run --with-mitsuba' does it, or PHOTONPROOF_MITSUBA_PYTHON names a Python that has "
      "it";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"mitsuba", path("scene.xml"), "-o", path("out.exr")}, {"mitsuba-version"}}) {
    std::vector<std::string> argv{"/usr/bin/env", "-u", "PHOTONPROOF_MITSUBA_PYTHON", "PATH=" + path("empty"),
                                  path("photonproof")};
    argv.insert(argv.end(), words.begin(), words.end());
    expect_end(run_process(argv), 3, message);
  }
}

TEST_F(VerbMitsuba, a_crash_leaves_nothing) {
  put_python("kill -ABRT $$");
  expect_end(mitsuba(), 70, "Mitsuba killed by SIGABRT: nothing was written");
}

TEST_F(VerbMitsuba, an_interrupt_leaves_nothing) {
  put_python("kill -INT $(ps -o ppid= -p $(ps -o ppid= -p $$)); sleep 60");
  expect_end(mitsuba(), 130, "interrupted: nothing was written");
}

TEST_F(VerbMitsuba, a_broken_image_leaves_nothing) {
  put_python(
      "echo broken > batch_0.exr; echo '{\"version\": \"\", \"variant\": \"\", \"import_seconds\": 1, "
      "\"load_seconds\": 2, \"compile_seconds\": 3, \"render_seconds\": 4}' > engine.json");
  const ProcessOutcome outcome = mitsuba();
  EXPECT_EQ(outcome.exit_code, 70);
  EXPECT_NE(outcome.standard_error.find("Mitsuba ended well and left an image that cannot be read"), std::string::npos)
      << outcome.standard_error;
  EXPECT_FALSE(has("out.exr"));
}

TEST_F(VerbMitsuba, refuses_with_3_before_mitsuba_is_started) {
  put_python("touch '" + path("started") + "'; exit 1");
  expect_end(
      mitsuba("difftrans"), 3,
      path("scene.xml") + ":1:223: error: not representable in Mitsuba: a diffuse transmitter: Mitsuba 3 has none");
  EXPECT_FALSE(has("started"));
}

TEST_F(VerbMitsuba, export_writes_the_scene_and_how_to_render_it) {
  put_scene();
  const ProcessOutcome plain =
      run_process({PHOTONPROOF_BINARY, "export", path("scene.xml"), "--for", "mitsuba", "-o", path("mine.xml")});
  ASSERT_TRUE(plain.ok()) << plain.standard_error;
  EXPECT_EQ(plain.standard_output, path("mine.xml") + ": render with: mitsuba " + path("mine.xml") + "\n");
  EXPECT_NE(get("mine.xml").find("<integrator type=\"path\">"), std::string::npos);
  put_scene("phong");
  const ProcessOutcome plugin = run_process({PHOTONPROOF_BINARY, "export", path("scene.xml"), "-o", path("mine.xml")});
  ASSERT_TRUE(plugin.ok()) << plugin.standard_error;
  EXPECT_EQ(plugin.standard_output, path("mine.xml") + ": render with: python3 " + path("mine_render.py") + " " +
                                        path("mine.xml") + " " + path("mine_render.json") +
                                        " .\nthen average batch_*.exr, weighed by their samples\n");
  EXPECT_NE(get("mine_render.py").find("def register_phong("), std::string::npos);
}

TEST_F(VerbMitsuba, export_never_replaces_the_scene) {
  put_scene();
  EXPECT_EQ(run_process({PHOTONPROOF_BINARY, "export", path("scene.xml"), "--for", "mitsuba", "-o", path("scene.xml")})
                .exit_code,
            2);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_engines
