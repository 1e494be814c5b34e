#include "harness/cells/calibration.h"

#include <gtest/gtest.h>

namespace photonproof {
namespace {

// What testing each of the 8000 rays against each of the 2^15 spheres gives, without boxes; in floats of IEEE 754,
// which no machine or build rounds otherwise.
TEST(Calibration, workload_is_the_same_work_everywhere) { EXPECT_EQ(CalibrationWorkload().run(), 167699262u); }

// One run of 10 ms after each cell is within the 50 ms that the harness has for one; 10 s pay for 50 ms, 1000 s for
// more than anybody needs.
TEST(Calibration, costs_half_a_percent_of_the_engine_or_one_run) {
  EXPECT_EQ(calibration_runs(0, 0.01), 1u);
  EXPECT_EQ(calibration_runs(1, 0.01), 1u);
  EXPECT_EQ(calibration_runs(10.1, 0.01), 5u);
  EXPECT_EQ(calibration_runs(1000, 0.01), 20u);
}

TEST(Calibration, reading_is_a_time_and_says_of_what) {
  Calibration calibration(2);
  const CalibrationReading reading = calibration.after_cell(0);
  EXPECT_GT(reading.seconds, 0);
  EXPECT_EQ(reading.threads, 2);
  EXPECT_EQ(reading.workload.substr(0, 3), "1 (");
}

}  // namespace
}  // namespace photonproof
