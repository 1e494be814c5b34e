// The program itself as a CI job calls it: compare's exit codes reach the shell.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "harness/metrics/test_images.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
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

// Memory that a tall pair may take beyond a short one. Program, libraries, the threads' tiles and flip's histogram take
// the same for both. At this width a band is 8 rows of tiles, 1024 pixel rows (metric_run.cpp, band_height):
//   rows of both images      2 x (1024 + 2 x 10 rows of reach) x 3 floats a pixel, twice while the next are made room
//   for scales 2 to 5 of ms_ssim 2 x 3 planes of doubles; the second has 1/4 of the pixels, all four 1/3 of them; twice
//   again relmse_trimmed           the errors of one band at most, thrice (parts, all of them, its growth), and one
//   double for
//                            2 of 1000 pixels of the whole image, twice
// Added up 12.8 + 8.4 + 6.3 + 0.3 = 28 MB; the images are 201 MB, and one of them is 101 MB.
TEST_F(CompareProgram, needs_memory_for_a_band_of_rows_and_not_for_the_images) {
  constexpr int width = 256, height = 1 << 15, band = 1024, reach = 10;
  constexpr double rows = 2.0 * (band + 2 * reach) * width * 3 * sizeof(float) * 2;
  constexpr double scales = 6.0 * (band * width / 3.0) * sizeof(double) * 2;
  constexpr double trimmed = (3.0 * band * width + 2 * 2.0 * width * height / 1000) * sizeof(double);
  constexpr double image = 3.0 * width * height * sizeof(float);
  static_assert(image > 3 * (rows + scales + trimmed));

  // Constant rows, since they are quickly packed; both images and their errors differ from row to row.
  const auto put_image = [&](const std::string& name, int rows_of_it, double error) {
    Image values(width, rows_of_it);
    for (int y = 0; y < rows_of_it; ++y) {
      const double value = 0.2 + 0.6 * y / rows_of_it;
      std::fill_n(values.pixel(0, y), 3 * width, static_cast<float>(value * (1 + error * (y % 11))));
    }
    write_exr(path(name), {std::move(values), std::nullopt, {}}, ExrColour::half);
  };
  const auto peak_of = [&](const std::string& name, int rows_of_it) {
    put_image("reference.exr", rows_of_it, 0);
    put_image(name, rows_of_it, 0.01);
    const ProcessOutcome outcome = compare(name, {"--threads", "2"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
    for (const char* metric : {"relmse_trimmed", "ms_ssim", "flip_max"}) {
      const std::size_t line = outcome.standard_output.find("\n" + std::string(metric) + " ");
      EXPECT_NE(line, std::string::npos) << metric;
      EXPECT_NE(outcome.standard_output.substr(line + 25, 1), "-") << metric;
    }
    return static_cast<double>(outcome.peak_bytes);
  };
  const double base = peak_of("short.exr", 256), peak = peak_of("tall.exr", height);
  EXPECT_LT(peak - base, rows + scales + trimmed);
  std::printf("%.0f MB, and %.0f MB more for the tall pair\n", base / 1e6, (peak - base) / 1e6);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
