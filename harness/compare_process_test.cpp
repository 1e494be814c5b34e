// The program itself as a CI job calls it: compare's exit codes reach the shell.

#include <gtest/gtest.h>

#include <limits>

#include "harness/metric_test_images.h"
#include "harness/test_folder.h"
#include "reference/process.h"

namespace photonproof {
namespace {

class CompareProgram : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write_exr(path("reference.exr"), {constant_image(12, 14, 1, 1, 1), std::nullopt, {}});
    write_exr(path("darker.exr"), {constant_image(12, 14, 0.75f, 0.75f, 0.75f), std::nullopt, {}});  // mse 0.0625
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  ProcessOutcome compare(const std::string& test, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {PHOTONPROOF_BINARY, "compare", path("reference.exr"), path(test)});
    return run_process(options, {.wall_limit_seconds = 20});
  }
  int exit_code(const std::string& test, const std::vector<std::string>& options = {}) const {
    const ProcessOutcome outcome = compare(test, options);
    EXPECT_EQ(outcome.end, ProcessOutcome::End::exited) << outcome.sentence();
    return outcome.exit_code;
  }
};

TEST_F(CompareProgram, exits_as_idiff_does) {
  EXPECT_EQ(exit_code("darker.exr", {"--warn", "mse=0.1", "--fail", "mse=0.2"}), 0);
  EXPECT_EQ(exit_code("darker.exr", {"--warn", "mse=0.01", "--fail", "mse=0.2"}), 1);
  EXPECT_EQ(exit_code("darker.exr", {"--warn", "mse=0.01", "--fail", "mse=0.02"}), 2);

  write_exr(path("wide.exr"), {constant_image(14, 12, 1, 1, 1), std::nullopt, {}});
  EXPECT_EQ(exit_code("wide.exr"), 3);
  EXPECT_EQ(exit_code("missing.exr"), 4);
  put("cut.exr", get("darker.exr").substr(0, 200));
  EXPECT_EQ(exit_code("cut.exr"), 4);
}

TEST_F(CompareProgram, fails_on_a_value_that_is_not_finite_and_says_where) {
  Image image = constant_image(12, 14, 1, 1, 1);
  image.pixel(11, 13)[1] = std::numeric_limits<float>::infinity();
  write_exr(path("infinite.exr"), {image, std::nullopt, {}});
  const ProcessOutcome outcome = compare("infinite.exr");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.standard_output.find("fail: pixel (11, 13) of the test image is +infinity in G; 1 non-finite in all\n"),
      std::string::npos)
      << outcome.standard_output;
}

TEST_F(CompareProgram, refuses_an_unknown_metric_in_one_line) {
  const ProcessOutcome outcome = compare("darker.exr", {"--fail", "ssmi=0.9"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error,
            "--fail: error: unknown metric 'ssmi'; the nearest is 'ssim', and compare --help lists all\n");
  EXPECT_EQ(outcome.standard_output, "");
}

}  // namespace
}  // namespace photonproof
