#include "harness/images/image_source.h"

#include <thread>

#include "harness/cells/cells.h"
#include "harness/cells/host.h"
#include "harness/suites/test_suite.h"

namespace photonproof::inline harness_images {
namespace {

using Parts = std::vector<std::pair<std::string, std::string>>;

class ImageSources : public FakeSuiteTest {
 protected:
  void SetUp() override {
    FakeSuiteTest::SetUp();
    engine_.name = "fake";
    engine_.command = {"sh", "{suite}/engine.sh", "grey", "{suite}", "{output}", "{stats}", "{scene}", "{seed}"};
    row_.name = "scene";
    row_.path = folder_ / "scene.xml";
    row_.width = width;
    row_.height = height;
    options_.folder = folder_ / "out";
    options_.program = "photonproof";
    options_.suite_folder = folder_;
    options_.limits = {.seconds = 20, .memory_mb = 2048, .threads = 2};
    options_.interrupt = &interrupt_;
    options_.starts = [this](const Cell& cell) { started_.push_back(cell.label()); };
    std::filesystem::create_directories(options_.folder);
  }

  std::optional<KeptImage> draw(std::uint64_t seed = 7) const {
    return ImageSource(options_).draw(by(), of(), budget_, seed);
  }
  std::string key(ImageUse use) {
    options_.use = use;
    return ImageSource(options_).key(by(), of(), budget_, 7);
  }
  ImageEngine by() const { return {&engine_, "fake 1"}; }
  ImageScene of() const { return {&row_, "hash", crop_}; }
  Parts content() const { return {{"scene", "hash"}, {"engine", engine_content(engine_)}, {"version", "fake 1"}}; }
  static Parts joined(Parts parts, const Parts& more) {
    parts.insert(parts.end(), more.begin(), more.end());
    return parts;
  }

  Engine engine_;
  SuiteScene row_;
  std::optional<FilmPart> crop_{};
  Budget budget_{"spp", 4};
  ImageSourceOptions options_;
  std::atomic<bool> interrupt_ = false;
  std::vector<std::string> started_;
};

// The parts and their order equal those of results kept by older versions.
TEST_F(ImageSources, keys_are_those_of_older_results) {
  const Parts drawn{{"budget", "spp=4"}, {"seed", "7"}, {"size", "32x24"}, {"seconds", "20.000000"}};
  const Parts limits{{"memory_mb", "2048"}, {"threads", "2"}};
  const Host host = describe_host();
  EXPECT_EQ(key(ImageUse::measurement), content_key(joined(joined(joined(content(), drawn), limits),
                                                           {{"host", host.cpu + "/" + std::to_string(host.cores)}})));
  EXPECT_EQ(key(ImageUse::verdict), content_key(joined(joined(joined(content(), {{"fault", ""}}), drawn), limits)));
  EXPECT_EQ(key(ImageUse::estimate), content_key(joined({{"verify", "1"}}, joined(content(), drawn))));
}

TEST_F(ImageSources, engine_s_own_file_and_crop_are_in_the_key) {
  const std::string whole = key(ImageUse::measurement);
  crop_ = FilmPart{{8, 6, width, height}, 4, 4};
  EXPECT_EQ(key(ImageUse::measurement), content_key({{"cell", whole}, {"crop", crop_->text()}}));
  put("own.pov", "camera {}");
  row_.files["fake"] = folder_ / "own.pov";
  const std::string with_file = content_key({{"cell", whole}, {"file", row_.file_content("fake")}});
  EXPECT_EQ(key(ImageUse::measurement), content_key({{"cell", with_file}, {"crop", crop_->text()}}));
}

TEST_F(ImageSources, image_comes_with_stats_and_status) {
  const std::optional<KeptImage> image = draw();
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(image->kept.result.status, Status::ok);
  EXPECT_EQ(image->kept.result.image, image->folder + "/image.exr");
  EXPECT_EQ(image->kept.result.engine_version, "fake 1");
  const ImageSource source(options_);
  EXPECT_EQ(source.image_of(image->kept.result).mean.rgb.front(), 0.5f);
  EXPECT_EQ(source.stats_of(*image).losses, std::vector<std::string>{"it only copies"});
}

TEST_F(ImageSources, kept_image_is_drawn_again_unless_its_status_is_reused) {
  const std::string first = draw()->folder;
  EXPECT_NE(draw()->folder, first);
  options_.reused = {Status::crash};
  EXPECT_EQ(draw()->folder.back(), '3');
  options_.reused = {Status::ok};
  EXPECT_EQ(draw()->folder.back(), '3');
  EXPECT_EQ(started_, std::vector<std::string>(3, "scene/fake/spp=4/seed=7"));
  draw(8);
  EXPECT_EQ(started_.size(), 4u);
}

TEST_F(ImageSources, interrupted_image_is_not_kept_and_its_folder_is_used_again) {
  interrupt_ = true;
  EXPECT_FALSE(draw().has_value());
  interrupt_ = false;
  options_.reused = {Status::ok};
  EXPECT_EQ(draw()->folder.back(), '1');
}

TEST_F(ImageSources, image_that_is_reused_is_drawn_once_for_all_threads) {
  options_.reused = {Status::ok};
  ImageSource source(options_);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back([&] { source.draw(by(), of(), budget_, 7); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(started_.size(), 1u);
}

TEST(ExitCode, is_read_from_a_result_that_failed) {
  Result result;
  result.status = Status::crash;
  for (const char* detail :
       {"exited with 2", "exited with 2: why", "exited with 2; for the 'x' beside the suite ..."}) {
    result.detail = detail;
    EXPECT_TRUE(exited_with(result, 2)) << detail;
    EXPECT_FALSE(exited_with(result, 1)) << detail;
  }
  result.detail = "exited with 21";
  EXPECT_FALSE(exited_with(result, 2));
  result.detail = "exited with 2";
  result.status = Status::unsupported;
  EXPECT_FALSE(exited_with(result, 2));
}

/// Ends every command at once with its own exit code.
class Nowhere : public Executor {
 public:
  ProcessOutcome run(const std::vector<std::string>& argv, const ProcessOptions& options) const override {
    EXPECT_EQ(argv.front(), "sh");
    EXPECT_EQ(options.wall_limit_seconds, 20);
    ProcessOutcome outcome;
    outcome.end = ProcessOutcome::End::exited;
    outcome.exit_code = unsupported_exit_code;
    outcome.standard_error = "nobody is here\n";
    return outcome;
  }
  int at_once(int) const override { return 1; }
};

/// Ends every command at its time limit.
class Slow : public Executor {
 public:
  ProcessOutcome run(const std::vector<std::string>&, const ProcessOptions& options) const override {
    limit = options.wall_limit_seconds;
    ProcessOutcome outcome;
    outcome.end = ProcessOutcome::End::timed_out;
    return outcome;
  }
  int at_once(int) const override { return 1; }
  mutable std::optional<double> limit{};
};

TEST_F(ImageSources, image_at_work_when_the_time_is_over_is_interrupted) {
  const Slow slow;
  options_.executor = &slow;
  EXPECT_EQ(draw()->kept.result.status, Status::timeout);
  options_.until = std::chrono::steady_clock::now();
  EXPECT_FALSE(draw(8).has_value());
  EXPECT_LE(slow.limit, 0);
  options_.until = std::chrono::steady_clock::now() + std::chrono::hours(1);
  EXPECT_EQ(draw(8)->kept.result.status, Status::timeout);
  EXPECT_EQ(slow.limit, 20);
}

TEST_F(ImageSources, executor_decides_where_engines_run) {
  const Nowhere nowhere;
  options_.executor = &nowhere;
  const std::optional<KeptImage> image = draw();
  EXPECT_EQ(image->kept.result.status, Status::unsupported);
  EXPECT_EQ(image->kept.result.detail, "nobody is here");
  EXPECT_EQ(started(), "");
}

}  // namespace
}  // namespace photonproof::inline harness_images
