#include "harness/cells/calibration.h"

#include <gtest/gtest.h>

namespace photonproof::inline harness_cells {
namespace {

// The sum that a test of each of the 8000 rays against each of the 2^15 spheres gives, without boxes. IEEE 754 floats
// round the same on every machine and in every build.
TEST(Calibration, workload_is_the_same_work_everywhere) { EXPECT_EQ(CalibrationWorkload().run(), 167699262u); }

// A reading is at least one run of 10 ms. An engine's 10 s pay for 50 ms; 1000 s would pay for more than the limit.
TEST(Calibration, costs_half_a_percent_of_the_engine_or_one_run) {
  EXPECT_EQ(calibration_runs(0, 0.01), 1u);
  EXPECT_EQ(calibration_runs(1, 0.01), 1u);
  EXPECT_EQ(calibration_runs(10.1, 0.01), 5u);
  EXPECT_EQ(calibration_runs(1000, 0.01), 20u);
}

TEST(Calibration, reading_is_a_time_and_says_of_what) {
  Calibration calibration(2);
  const CalibrationReading reading = calibration.after_cell({"cornell", "path", {"spp", 1}, 1}, 0);
  EXPECT_GT(reading.seconds, 0);
  EXPECT_EQ(reading.threads, 2);
  EXPECT_EQ(reading.workload.substr(0, 3), "1 (");
}

// 200 cells of 0.02 s, seeds of one kind never next to each other: a reading when 0.25 s are over, after 13 of them.
TEST(Calibration, short_cells_share_a_reading) {
  ReadingSchedule schedule;
  int readings = 0;
  for (int i = 0; i < 200; ++i)
    readings += schedule.is_due({"scene" + std::to_string(i % 20), "path", {"spp", 1}, static_cast<unsigned>(i)}, 0.02);
  EXPECT_EQ(readings, 200 / 13);
}

TEST(Calibration, cells_that_share_a_reading_have_the_same_one) {
  Calibration calibration(1);
  const auto after = [&](const char* scene, double seconds) {
    return calibration.after_cell({scene, "path", {"spp", 1}, 1}, seconds).seconds;
  };
  const double first = after("a", 0.01);
  EXPECT_EQ(after("b", 0.01), first);
  EXPECT_EQ(after("c", 0.01), first);
}

// Noise of a reading that two seeds share would not show in the scatter of their ratios.
TEST(Calibration, seeds_of_one_kind_of_cell_share_no_reading) {
  ReadingSchedule schedule;
  EXPECT_FALSE(schedule.is_due({"a", "path", {"spp", 1}, 1}, 0));
  EXPECT_FALSE(schedule.is_due({"a", "path", {"spp", 2}, 1}, 0));
  EXPECT_FALSE(schedule.is_due({"a", "bdpt", {"spp", 1}, 1}, 0));
  EXPECT_TRUE(schedule.is_due({"a", "path", {"spp", 1}, 2}, 0));
  EXPECT_TRUE(schedule.is_due({"a", "path", {"spp", 1}, 3}, 0));
}

TEST(Calibration, long_cell_has_a_reading_of_its_own) {
  ReadingSchedule schedule;
  for (const char* scene : {"a", "b", "c"}) EXPECT_TRUE(schedule.is_due({scene, "path", {"spp", 1}, 1}, 0.3));
}

}  // namespace
}  // namespace photonproof::inline harness_cells
