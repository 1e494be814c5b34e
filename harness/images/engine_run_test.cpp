#include "harness/images/engine_run.h"

#include <algorithm>
#include <atomic>
#include <regex>
#include <thread>
#include <vector>

#include "harness/cells/host.h"
#include "harness/suites/test_suite.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_images {
namespace {

class EngineRuns : public FakeSuiteTest {
 protected:
  std::optional<Result> run_command(const std::vector<std::string>& command, const std::string& layer = "") {
    engine_.command = command;
    engine_.layer = layer;
    scene_.name = "scene";
    scene_.path = folder_ / "scene.xml";
    scene_.width = width;
    scene_.height = height;
    EngineRun run{{&engine_}, {&scene_, "", crop_}, {"spp", 1}, 1, limits_, "photonproof", folder_};
    run.results_folder = folder_.parent_path();
    run.folder = folder_.filename();
    run.interrupt = &interrupt_;
    return run_engine(run);
  }
  std::optional<Result> run(const std::string& behaviour) {
    engine_.name = behaviour;
    return run_command({"sh", folder_ / "engine.sh", behaviour, folder_, "{output}", "{stats}", "{scene}", "{seed}"});
  }
  std::string ending(const std::string& behaviour) {
    const std::optional<Result> result = run(behaviour);
    return result ? to_string(result->status) + "|" + result->detail : "interrupted";
  }

  std::optional<FilmPart> crop_{};
  Engine engine_;
  SuiteScene scene_;
  Limits limits_{.seconds = 20, .memory_mb = 2048, .threads = 1};
  std::atomic<bool> interrupt_ = false;
};

TEST_F(EngineRuns, good_image_is_ok_with_its_cost_and_stats) {
  const std::optional<Result> result = run("grey");
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->status, Status::ok);
  EXPECT_EQ(result->detail, "");
  EXPECT_GT(result->wall_seconds.value(), 0);
  EXPECT_GT(result->peak_bytes.value(), 0u);
  EXPECT_TRUE(result->cpu_seconds.has_value());
  EXPECT_EQ(result->phases, (std::map<std::string, double>{{"copy", 0.25}}));
  EXPECT_EQ(std::count(result->caveats.begin(), result->caveats.end(), "declared by the engine: it only copies"), 1);
  EXPECT_EQ(result->command.substr(0, 3), "sh ");
  EXPECT_EQ(result->cell.label(), "scene/grey/spp=1/seed=1");
  EXPECT_EQ(result->image, folder_.filename() / "image.exr");
}

TEST_F(EngineRuns, denoised_image_counts_only_where_the_row_says_so) {
  EXPECT_EQ(ending("denoises"),
            "bad_image|the image is denoised by Denoiser 2.5, and the engine's row lacks denoise = true");
  engine_.denoises = true;
  EXPECT_EQ(ending("denoises"), "ok|");
  const std::vector<std::string> caveats = run("denoises")->caveats;
  EXPECT_EQ(std::ranges::count(caveats, "denoised by Denoiser 2.5, which is biased"), 1);
}

TEST_F(EngineRuns, image_of_the_whole_film_or_of_the_crop_is_kept_as_the_crop) {
  crop_ = FilmPart{{8, 6, width, height}, 4, 4};
  for (const char* engine : {"grey", "small"}) {
    EXPECT_EQ(ending(engine), "ok|") << engine;
    const Rendering kept = read_stored(folder_ / "image.exr");
    EXPECT_EQ(kept.place, (ImagePlace{8, 6, width, height})) << engine;
    EXPECT_EQ(std::pair(kept.mean.width, kept.mean.height), std::pair(4, 4)) << engine;
    EXPECT_EQ(kept.mean.rgb, std::vector<float>(48, 0.5f)) << engine;
  }
  crop_->width = 5;
  EXPECT_EQ(ending("small"), "bad_image|wrote 4x4 pixels instead of 32x24 or the crop's 5x4");
}

TEST_F(EngineRuns, hanging_engine_is_a_timeout) {
  limits_.seconds = 0.3;
  EXPECT_TRUE(std::regex_match(  // on a busy machine a second run has more time
      ending("hangs"), std::regex("timeout.killed after [0-9.]+ s .limit.")))
      << ending("hangs");
}

// The engine computes until it is killed, and in a second run not at all. What the first run wrote does not count. Four
// programs a core take its time. The test ends them.
TEST_F(EngineRuns, engine_that_other_work_slows_runs_once_more) {
  limits_.seconds = 0.5;
  put("works.sh",
      "[ -e \"$1/seen\" ] && exec cp -n \"$1/grey.exr\" \"$2\"; echo half >\"$2\"; touch \"$1/seen\"; while :; do :; "
      "done");
  const std::vector<std::string> command{"sh", folder_ / "works.sh", folder_, "{output}"};
  std::atomic<bool> done = false;
  std::vector<std::jthread> others;
  for (int i = 0; i < 4 * describe_host().cores; ++i)
    others.emplace_back([&] {
      run_process({"sh", "-c", "while :; do :; done"}, {.wall_limit_seconds = 20, .interrupt = &done});
    });
  const std::optional<Result> result = run_command(command);
  done = true;
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(to_string(result->status) + "|" + result->detail, "ok|");
  EXPECT_TRUE(
      std::ranges::any_of(result->caveats, [](const auto& text) { return text.starts_with("a second run, with "); }));
}

TEST_F(EngineRuns, greedy_engine_is_a_crash) {
  limits_.memory_mb = 64;
  EXPECT_EQ(ending("hog"), "crash|used more than 64 MiB of memory (limit)");
}

TEST_F(EngineRuns, dying_engine_is_a_crash) { EXPECT_EQ(ending("segfaults"), "crash|killed by SIGSEGV"); }

TEST_F(EngineRuns, failing_engine_is_a_crash_with_its_last_words) {
  EXPECT_EQ(ending("fails"), "crash|exited with 5: out of ideas");
  EXPECT_EQ(get("stderr.txt"), "first words\nout of ideas\n");
  EXPECT_FALSE(has("stdout.txt"));
}

TEST_F(EngineRuns, refusal_is_unsupported_with_its_reason) {
  EXPECT_EQ(ending("refuses"), "unsupported|no mirrors here");
}

TEST_F(EngineRuns, engine_that_cannot_be_started_says_so_without_a_cost) {
  const std::optional<Result> result = run_command({"no-such-engine"});
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->status, Status::not_started);
  EXPECT_EQ(result->detail, "could not be started: 'no-such-engine': No such file or directory; it is not on PATH");
  EXPECT_FALSE(result->wall_seconds.has_value());
  EXPECT_FALSE(result->peak_bytes.has_value());
}

TEST_F(EngineRuns, no_image_is_a_bad_image) { EXPECT_EQ(ending("silent"), "bad_image|wrote no image"); }

TEST_F(EngineRuns, other_size_is_a_bad_image) {
  EXPECT_EQ(ending("small"), "bad_image|wrote 4x4 pixels instead of 32x24");
}

TEST_F(EngineRuns, value_that_is_not_finite_is_a_bad_image) {
  // 16 x 12 pixels of three channels are 576 values.
  EXPECT_EQ(ending("nan"), "bad_image|pixel (0, 0) of the test image is NaN in R; 2304 non-finite in all");
}

TEST_F(EngineRuns, half_an_image_is_a_bad_image) {
  EXPECT_TRUE(ending("half").starts_with("bad_image|wrote an image that cannot be read: ")) << ending("half");
}

TEST_F(EngineRuns, garbage_is_a_bad_image) {
  EXPECT_TRUE(ending("garbage").starts_with("bad_image|wrote an image that cannot be read: ")) << ending("garbage");
}

TEST_F(EngineRuns, broken_stats_are_a_caveat_only) {
  const std::optional<Result> result = run("bad_stats");
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->status, Status::ok);
  EXPECT_NE(
      std::find(result->caveats.begin(), result->caveats.end(), "its stats cannot all be used: it is not valid JSON"),
      result->caveats.end());
}

TEST_F(EngineRuns, sleeping_engine_gets_a_caveat_about_its_timing) {
  // It sleeps half a second and copies a file: far less than half of its wall time is CPU time.
  const std::optional<Result> result = run("sleeps");
  ASSERT_TRUE(result.has_value());
  const auto waited = [](const std::string& caveat) {
    return caveat.starts_with("waited more than it computed (CPU ");
  };
  EXPECT_EQ(std::count_if(result->caveats.begin(), result->caveats.end(), waited), 1);
}

TEST_F(EngineRuns, interrupted_run_has_no_result) {
  interrupt_ = true;
  EXPECT_EQ(ending("grey"), "interrupted");
}

TEST_F(EngineRuns, words_of_an_engine_are_no_commands_to_a_terminal) {
  EXPECT_EQ(ending("escapes"), "crash|exited with 5: ?]0;owned??[2Jred?31m");
}

TEST_F(EngineRuns, temporaries_of_a_killed_engine_are_removed) {
  limits_.seconds = 0.5;
  EXPECT_EQ(run("leaves_temporary")->status, Status::timeout);
  for (const auto& file : std::filesystem::directory_iterator(folder_))
    EXPECT_EQ(file.path().filename().string().find(".partial-"), std::string::npos) << file.path();
}

// The channels variance.R, G and B form a layer, although they are not called R, G and B.
TEST_F(EngineRuns, layer_of_the_engine_s_image_is_all_that_is_kept) {
  Rendering layers{Image(width, height), Image(width, height), {}};
  for (float& value : layers.mean.rgb) value = 1;
  for (float& value : layers.variance->rgb) value = 0.25f;
  const auto shot = [&](const std::string& layer) {
    write_exr((folder_ / "layers.exr").string(), layers);
    std::string bytes = read_file(folder_ / "layers.exr");
    for (std::size_t at = 0; (at = bytes.find("variance.", at)) != std::string::npos;) bytes.replace(at, 8, "indirect");
    write_file_atomically(folder_ / "layers.exr", bytes);
    return run_command({"cp", folder_ / "layers.exr", "{output}"}, layer).value();
  };
  EXPECT_EQ(shot("").status, Status::ok);
  EXPECT_EQ(read_image((folder_ / "image.exr").string()).rgb.front(), 1);
  const Result result = shot("indirect");
  EXPECT_EQ(result.status, Status::ok) << result.detail;
  const Rendering kept = read_rendering((folder_ / "image.exr").string());
  EXPECT_EQ(kept.mean.rgb, std::vector<float>(kept.mean.rgb.size(), 0.25f));
  EXPECT_FALSE(kept.variance);
  EXPECT_EQ(result.image_checksum, file_checksum(folder_ / "image.exr"));
  EXPECT_EQ(shot("beauty").status, Status::bad_image);
  layers.variance.reset();
  EXPECT_EQ(shot("beauty").detail, "wrote an image without layers, not even 'beauty'");
}

TEST_F(EngineRuns, image_has_its_checksum) {
  EXPECT_EQ(run("grey")->image_checksum, file_checksum(folder_ / "grey.exr"));
  std::filesystem::remove(folder_ / "image.exr");
  EXPECT_EQ(run("silent")->image_checksum, "");
}

}  // namespace
}  // namespace photonproof::inline harness_images
