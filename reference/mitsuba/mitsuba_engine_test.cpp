// Results of running Mitsuba, tested with stand-in programs that imitate its behaviour, and once by Mitsuba itself.
#include "reference/mitsuba/mitsuba_engine.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "reference/mitsuba/mitsuba_python.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/mean_error.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_mitsuba {
namespace {

namespace fs = std::filesystem;

class MitsubaEngine : public FolderTest {
 protected:
  MitsubaEngine() {
    scene.picture.width = scene.picture.height = scene.picture.film.width = scene.picture.film.height = 4;
    scene.picture.batches = {{4, 1}, {4, 2}};
    scene.samples = 8;
    scene.threads = 1;
    scene.variant = "auto";
  }

  /// Runs a shell script in the interpreter's place. It starts in the folder of its images; `$made` is the test's.
  MitsubaRun run(const std::string& script) {
    put("python", "#!/bin/sh\nmade='" + folder_.string() + "'\n" + script + "\n");
    fs::permissions(folder_ / "python", fs::perms::owner_all);
    options.python = (folder_ / "python").string();
    return render_mitsuba(scene, options);
  }

  /// The message that is thrown as a failure of the engine.
  std::string failure(const std::string& script, EngineFailure::Kind kind = EngineFailure::Kind::failed) {
    try {
      run(script);
      return "no failure";
    } catch (const EngineFailure& error) {
      EXPECT_EQ(error.kind, kind);
      return error.what();
    }
  }

  void put_image(const std::string& name, float value, int size = 4) const {
    Rendering rendering;
    rendering.mean = Image(size, size);
    for (float& v : rendering.mean.rgb) v = value;
    write_exr((folder_ / name).string(), rendering);
  }

  static constexpr const char* facts =
      "echo '{\"version\": \"Mitsuba 9.9\", \"variant\": \"scalar_rgb\", \"import_seconds\": 1, \"load_seconds\": 2, "
      "\"compile_seconds\": 3, \"render_seconds\": 4}' > engine.json; ";

  MitsubaExport scene;
  MitsubaRunOptions options;
};

// Two batches of the same size: the variance of their mean is ((1 - 2)^2 + (3 - 2)^2) / 2 / 1 = 1.
TEST_F(MitsubaEngine, batches_are_averaged_and_their_spread_is_the_variance) {
  put_image("a.exr", 1);
  put_image("b.exr", 3);
  const MitsubaRun done = run(std::string(facts) + "cp $made/a.exr batch_0.exr; cp $made/b.exr batch_1.exr");
  EXPECT_EQ(done.version, "Mitsuba 9.9");
  EXPECT_EQ(done.variant, "scalar_rgb");
  EXPECT_EQ(done.import_seconds, 1);
  EXPECT_EQ(done.load_seconds, 2);
  EXPECT_EQ(done.compile_seconds, 3);
  EXPECT_EQ(done.render_seconds, 4);
  EXPECT_FLOAT_EQ(done.rendering.mean.rgb[5], 2);
  ASSERT_TRUE(done.rendering.variance);
  EXPECT_FLOAT_EQ(done.rendering.variance->rgb[5], 1);
  EXPECT_DOUBLE_EQ(stored_mean_error(done.rendering)->standard_error[0], 1);
  EXPECT_DOUBLE_EQ(done.relative_standard_error, 0.5);
  EXPECT_EQ(done.rendering.metadata.at("photonproof:variant"), "scalar_rgb");
  EXPECT_TRUE(done.defects.empty());
}

TEST_F(MitsubaEngine, its_script_gets_the_scene_the_variant_the_threads_and_the_batches) {
  put_image("a.exr", 1);
  scene.text = "<scene/>";
  run(std::string(facts) +
      "cp options.json scene.xml render.py $made; cp $made/a.exr batch_0.exr; cp $made/a.exr batch_1.exr");
  EXPECT_EQ(get("options.json"), "{\"variant\":\"auto\",\"threads\":1,\"plugins\":[],\"batches\":[[4,1],[4,2]]}\n");
  EXPECT_EQ(get("scene.xml"), "<scene/>");
  EXPECT_NE(get("render.py").find("def register_plugins("), std::string::npos);
}

TEST_F(MitsubaEngine, a_python_that_cannot_be_started_is_bad_input) {
  options.python = (folder_ / "none").string();
  EXPECT_EQ(input_error_of([&] { render_mitsuba(scene, options); }),
            options.python + ": error: the Python that has Mitsuba cannot be run ('" + options.python +
                "': No such file or directory)");
}

TEST_F(MitsubaEngine, a_python_exception_is_told_by_its_last_line) {
  EXPECT_EQ(failure("printf 'Traceback (most recent call last):\\n  File \"render.py\", line 7, in <module>\\n"
                    "RuntimeError: no such plugin\\n' >&2; exit 1"),
            "Mitsuba exited with 1: RuntimeError: no such plugin");
}

TEST_F(MitsubaEngine, an_error_of_the_script_is_told) {
  EXPECT_EQ(failure("echo 'Error: Mitsuba has no variant x' >&2; exit 1"),
            "Mitsuba exited with 1: Error: Mitsuba has no variant x");
}

TEST_F(MitsubaEngine, a_crash_is_named) { EXPECT_EQ(failure("kill -ABRT $$"), "Mitsuba killed by SIGABRT"); }

TEST_F(MitsubaEngine, a_run_past_its_time_is_ended) {
  options.wall_limit_seconds = 0.3;
  EXPECT_EQ(failure("sleep 60", EngineFailure::Kind::limit), "Mitsuba was killed after 0.3 s (limit)");
}

TEST_F(MitsubaEngine, an_interrupt_ends_it) {
  const std::atomic<bool> interrupt = true;
  options.interrupt = &interrupt;
  EXPECT_EQ(failure("sleep 60", EngineFailure::Kind::interrupted), "Mitsuba was interrupted");
}

TEST_F(MitsubaEngine, files_that_are_missing_or_broken_are_failures) {
  put_image("a.exr", 1);
  EXPECT_EQ(failure("true"), "Mitsuba ended well and left no engine.json");
  EXPECT_EQ(failure("echo '{' > engine.json"), "Mitsuba ended well and left an engine.json that cannot be read");
  EXPECT_EQ(failure("echo '{}' > engine.json"), "Mitsuba ended well and left an engine.json that cannot be read");
  EXPECT_EQ(failure(std::string(facts) + "cp $made/a.exr batch_0.exr"),
            "Mitsuba ended well and wrote no image batch_1.exr");
}

TEST_F(MitsubaEngine, values_that_are_no_numbers_are_defects) {
  put_image("a.exr", 1);
  put_image("b.exr", INFINITY);
  const MitsubaRun done = run(std::string(facts) + "cp $made/a.exr batch_0.exr; cp $made/b.exr batch_1.exr");
  ASSERT_EQ(done.defects.size(), 1u);
  EXPECT_EQ(done.defects[0], "48 values are not finite, the first in pixel (0, 0): Mitsuba found no number");
}

TEST_F(MitsubaEngine, its_python_is_the_variable_s_then_that_of_the_tree) {
  fs::create_directories(folder_ / "build/release/bin");
  fs::create_directories(folder_ / "build/peers/bin");
  put("build/release/bin/photonproof", "");
  put("build/peers/bin/python", "");
  const char* given = std::getenv(mitsuba_python_variable);
  const std::string kept = given == nullptr ? "" : given;
  setenv(mitsuba_python_variable, "/some/python", 1);
  EXPECT_EQ(find_mitsuba_python(folder_ / "build/release/bin/photonproof"), "/some/python");
  unsetenv(mitsuba_python_variable);
  EXPECT_EQ(find_mitsuba_python(folder_ / "build/release/bin/photonproof"),
            fs::canonical(folder_ / "build/peers/bin/python").string());
  if (!kept.empty()) setenv(mitsuba_python_variable, kept.c_str(), 1);
}

/// Mitsuba itself, where it is installed.
class MitsubaItself : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto python = find_mitsuba_python(fs::read_symlink("/proc/self/exe"));
    if (!python || mitsuba_version(*python).empty())
      GTEST_SKIP() << "Mitsuba is not installed: ./run --with-mitsuba installs it";
    options.python = *python;
  }
  double mean_of(const std::string& content) {
    const SceneDescription scene = parse_scene_text(
        "<scene version='3.0.0'><sensor type='fisheye'><film type='hdrfilm'><integer name='width' value='8'/><integer "
        "name='height' value='8'/><rfilter type='box'/></film></sensor>" +
            content + "</scene>",
        "s.xml", {{}, true});
    const MitsubaExport exported = export_mitsuba(scene, {.samples = 64, .threads = 1, .variant = GetParam()});
    const MitsubaRun run = render_mitsuba(exported, options);
    EXPECT_TRUE(run.rendering.variance);
    double sum = 0;
    for (const float value : run.rendering.mean.rgb) sum += double{value};
    return sum / double(run.rendering.mean.rgb.size());
  }
  MitsubaRunOptions options;
};

// A hemisphere fills pi / 4 of the picture; a mirror blended with white in a sky of 2 returns it all.
TEST_P(MitsubaItself, sees_a_sky_of_2_in_the_circle_of_a_fisheye) {
  EXPECT_NEAR(mean_of("<emitter type='constant'><rgb name='radiance' value='2'/></emitter>"), 2 * M_PI / 4, 0.02);
}
TEST_P(MitsubaItself, sees_no_edge_of_a_white_ball_that_mirrors_in_part) {
  EXPECT_NEAR(mean_of("<emitter type='constant'><rgb name='radiance' value='2'/></emitter><shape type='sphere'><point "
                      "name='center' value='0,0,3'/><bsdf type='blendbsdf'><float name='weight' value='0.3'/><bsdf "
                      "type='diffuse'><rgb name='reflectance' value='1'/></bsdf><bsdf type='conductor'><string "
                      "name='material' value='none'/></bsdf></bsdf></shape>"),
              2 * M_PI / 4, 0.02);
}

INSTANTIATE_TEST_SUITE_P(variants, MitsubaItself, testing::Values("scalar_rgb", "auto"));

}  // namespace
}  // namespace photonproof::inline reference_mitsuba
