// The texts of --progress, by a clock of the test's own.
#include "harness/verbs/usage/progress.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace photonproof::inline harness_verbs_usage {
namespace {

/// The output of `use`, which gets a Progress of this mode and sets the clock's seconds.
template <class Use>
std::string output_of(const std::string& mode, const Use& use) {
  double seconds = 0;
  testing::internal::CaptureStderr();
  {
    Progress progress(mode, [&seconds] { return seconds; });
    use(progress, seconds);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(progress, on_a_line_has_number_rate_and_time_left) {
  // 30 of 90 cells in 60 s leave 60 at half a cell a second: 2 minutes. The first 10 were there before.
  EXPECT_EQ(output_of("line",
                      [](Progress& progress, double& seconds) {
                        progress.at({10, 100, "box", "cells"});
                        seconds = 60;
                        progress.at({40, 100, "box", "cells"});
                      }),
            "\r[10/100] box\x1b[K\r[40/100] box, 0.5 cells/s, 2 min left\x1b[K\r\x1b[K");
  EXPECT_EQ(output_of("line",
                      [](Progress& progress, double& seconds) {
                        progress.at({0, 1, "photons"});
                        seconds = 9;
                        progress.at({0.25, 1, "photons"});
                        progress.say("done");
                        progress.at({.phase = "metrics"});
                      }),
            "\r  0 % photons\x1b[K\r 25 % photons, 27 s left\x1b[K\r\x1b[Kdone\n\rmetrics\x1b[K\r\x1b[K");
}

TEST(progress, in_a_log_is_a_line_a_minute) {
  EXPECT_EQ(output_of("log",
                      [](Progress& progress, double& seconds) {
                        for (int i = 0; i <= 150; ++i) {
                          seconds = i;
                          progress.at({i / 200.0, 1, "samples"});
                          if (i == 70) progress.say("a gate passes");
                        }
                      }),
            " 30 % samples, 2 min left\na gate passes\n 60 % samples, 1 min left\n");
}

TEST(progress, as_json_is_an_object_a_line_at_most_two_a_second) {
  std::istringstream lines(output_of("json", [](Progress& progress, double& seconds) {
    for (int i = 0; i < 10; ++i) {
      seconds = 0.1 * i;
      progress.at({static_cast<double>(i), 20, "a\xFF", "cells"});
    }
    progress.say("kept");
    seconds = 3;
    progress.at({.phase = "page"});
  }));
  std::vector<nlohmann::json> objects;
  for (std::string line; std::getline(lines, line);) objects.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(objects.size(), 4u);
  EXPECT_EQ(
      objects[0],
      (nlohmann::json{
          {"seconds", 0.0}, {"done", 0}, {"total", 20}, {"fraction", 0}, {"seconds_left", nullptr}, {"phase", "a?"}}));
  EXPECT_EQ(objects[1]["done"], 5);
  EXPECT_NEAR(objects[1]["seconds_left"].get<double>(), 1.5, 1e-9);
  EXPECT_EQ(objects[2]["message"], "kept");
  EXPECT_EQ(objects[3]["fraction"], nullptr);
}

TEST(progress, none_is_silent) {
  EXPECT_EQ(output_of("none",
                      [](Progress& progress, double& seconds) {
                        seconds = 1000;
                        progress.at({1, 2, "x"});
                        progress.say("y");
                        EXPECT_FALSE(progress.callback());
                      }),
            "");
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_usage
