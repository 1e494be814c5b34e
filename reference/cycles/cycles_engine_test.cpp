// Results of running Blender, tested with stand-in programs that imitate Blender's behaviour.
#include "reference/cycles/cycles_engine.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "scenes/files/test_folder.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline reference_cycles {
namespace {

namespace fs = std::filesystem;

class CyclesEngine : public FolderTest {
 protected:
  CyclesEngine() {
    scene.width = scene.height = scene.film.width = scene.film.height = 4;
    scene.samples = 8;
    scene.threads = 1;
    scene.batches = {{4, 1}, {4, 2}};
  }

  /// Runs a shell script in Blender's place; `$images` is the folder of its images, `$made` that of the test's.
  CyclesRun run(const std::string& script) {
    put("blender", "#!/bin/sh\nfor last; do :; done\nimages=$(dirname \"$last\")\nmade='" + folder_.string() + "'\n" +
                       script + "\n");
    fs::permissions(folder_ / "blender", fs::perms::owner_all);
    options.program = (folder_ / "blender").string();
    return render_cycles(scene, options);
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

  CyclesExport scene;
  CyclesRunOptions options;
};

// Two batches of the same size: the variance of their mean is ((1 - 2)^2 + (3 - 2)^2) / 2 / 1 = 1.
TEST_F(CyclesEngine, batches_are_averaged_and_their_spread_is_the_variance) {
  put_image("a.exr", 1);
  put_image("b.exr", 3);
  const CyclesRun done =
      run("echo 'Blender 3.4.1'; cp $made/a.exr $images/batch_0.exr; cp $made/b.exr $images/batch_1.exr");
  EXPECT_EQ(done.version, "Blender 3.4.1");
  EXPECT_EQ(done.command, options.program + " -b --factory-startup --python-exit-code 1 --python scene.py");
  EXPECT_FLOAT_EQ(done.rendering.mean.rgb[5], 2);
  ASSERT_TRUE(done.rendering.variance);
  EXPECT_FLOAT_EQ(done.rendering.variance->rgb[5], 1);
  EXPECT_DOUBLE_EQ(stored_mean_error(done.rendering)->standard_error[0], 1);
  EXPECT_DOUBLE_EQ(done.relative_standard_error, 0.5);
  EXPECT_EQ(done.rendering.metadata.at("photonproof:batches"), "2");
  EXPECT_TRUE(done.defects.empty());
}

// Weighted by 6 and 2 of 8 samples the mean is 1.5, and the variance (3/4 (1/2)^2 + 1/4 (3/2)^2) / 1 = 3/4.
TEST_F(CyclesEngine, batches_weigh_by_their_samples) {
  scene.batches = {{6, 1}, {2, 2}};
  put_image("a.exr", 1);
  put_image("b.exr", 3);
  const CyclesRun done = run("cp $made/a.exr $images/batch_0.exr; cp $made/b.exr $images/batch_1.exr");
  EXPECT_FLOAT_EQ(done.rendering.mean.rgb[0], 1.5);
  EXPECT_FLOAT_EQ(done.rendering.variance->rgb[0], 0.75);
}

TEST_F(CyclesEngine, one_batch_says_nothing_of_its_variance) {
  scene.batches = {{8, 1}};
  put_image("a.exr", 1);
  EXPECT_FALSE(run("cp $made/a.exr $images/batch_0.exr").rendering.variance);
}

TEST_F(CyclesEngine, a_missing_program_is_bad_input_that_says_what_to_install) {
  options.program = (folder_ / "none").string();
  EXPECT_EQ(input_error_of([&] { render_cycles(scene, options); }),
            options.program + ": error: Blender cannot be run ('" + options.program +
                "': No such file or directory); on Debian: apt install blender");
}

TEST_F(CyclesEngine, a_python_exception_is_told_by_its_last_line) {
  EXPECT_EQ(failure("echo 'Traceback (most recent call last):\n  File \"scene.py\", line 7, in <module>\n    "
                    "explode()\nNameError: name is not defined\n\nBlender quit' >&2; exit 1"),
            "Blender exited with 1: NameError: name is not defined");
}

TEST_F(CyclesEngine, a_killed_child_is_named) { EXPECT_EQ(failure("kill -9 $$"), "Blender killed by SIGKILL"); }

TEST_F(CyclesEngine, a_run_past_its_time_is_ended_with_all_its_children) {
  options.wall_limit_seconds = 0.3;
  EXPECT_EQ(failure("sleep 60 & sleep 60", EngineFailure::Kind::limit), "Blender was killed after 0.3 s (limit)");
}

TEST_F(CyclesEngine, an_interrupt_ends_it) {
  const std::atomic<bool> interrupt = true;
  options.interrupt = &interrupt;
  EXPECT_EQ(failure("sleep 60", EngineFailure::Kind::interrupted), "Blender was interrupted");
}

TEST_F(CyclesEngine, images_that_are_missing_broken_or_of_another_size_are_failures) {
  put_image("a.exr", 1);
  put_image("large.exr", 1, 5);
  EXPECT_EQ(failure("cp $made/a.exr $images/batch_0.exr"), "Blender ended well and wrote no image batch_1.exr");
  const std::string broken =
      failure("cp $made/a.exr $images/batch_0.exr; head -c 200 $made/a.exr > $images/batch_1.exr");
  EXPECT_EQ(broken.rfind("Blender ended well and left an image that cannot be read: ", 0), 0u) << broken;
  EXPECT_EQ(failure("cp $made/a.exr $images/batch_0.exr; cp $made/large.exr $images/batch_1.exr"),
            "Blender ended well and wrote an image of 5x5 where 4x4 was asked for");
}

TEST_F(CyclesEngine, values_that_are_no_numbers_are_defects) {
  put_image("a.exr", 1);
  put_image("b.exr", INFINITY);
  const CyclesRun done = run("cp $made/a.exr $images/batch_0.exr; cp $made/b.exr $images/batch_1.exr");
  ASSERT_EQ(done.defects.size(), 1u);
  EXPECT_EQ(done.defects[0], "48 values are not finite, the first in pixel (0, 0): Cycles found no number");
}

TEST_F(CyclesEngine, pictures_that_are_done_are_progress) {
  scene.batches = {{8, 1}};
  put_image("a.exr", 1);
  std::vector<double> shares;
  options.progress = [&](double share, const std::string&) { shares.push_back(share); };
  run("cp $made/a.exr $images/batch_0.exr; echo 'photonproof: 1' >&2; echo noise >&2");
  EXPECT_EQ(shares, std::vector<double>{1});
}

TEST_F(CyclesEngine, nothing_is_left_behind) {
  scene.batches = {{8, 1}};
  put_image("a.exr", 1);
  run("cp $made/a.exr $images/batch_0.exr; echo $images > $made/where");
  std::string where = get("where");
  where.pop_back();
  EXPECT_FALSE(fs::exists(where));
}

}  // namespace
}  // namespace photonproof::inline reference_cycles
