#include "harness/cells/others_busy.h"

#include <gtest/gtest.h>

#include "harness/cells/host.h"

namespace photonproof::inline harness_cells {
namespace {

TEST(OthersBusy, time_grows_as_the_rest_of_the_machine_shrinks) {
  constexpr double busy = 1;  // a thread that always runs when it may
  EXPECT_EQ(time_beside_others(0, busy, 2), 1);
  EXPECT_EQ(time_beside_others(0.4, busy, 2), 1);
  EXPECT_DOUBLE_EQ(time_beside_others(1, busy, 2), 2);      // half of the machine is left
  EXPECT_DOUBLE_EQ(time_beside_others(1.5, busy, 2), 4);    // a quarter
  EXPECT_DOUBLE_EQ(time_beside_others(1.99, busy, 2), 20);  // next to nothing
  EXPECT_DOUBLE_EQ(time_beside_others(2.2, busy, 2), 20);   // more than all, by the clocks' resolution
}

TEST(OthersBusy, a_program_that_sleeps_has_no_more_time_for_others_work) {
  EXPECT_EQ(time_beside_others(1.99, 0, 2), 1);
  EXPECT_EQ(time_beside_others(1.99, 0.0001, 2), 1);         // 1 + 19 * 0.0001 / 0.05 = 1.04
  EXPECT_DOUBLE_EQ(time_beside_others(1.5, 0.25, 2), 4);     // everything that others left
  EXPECT_DOUBLE_EQ(time_beside_others(1.5, 0.125, 2), 2.5);  // half of that: 1 + (4 - 1) / 2
}

TEST(OthersBusy, our_own_work_is_not_others) {
  const OthersBusy busy;
  const double start = own_cpu_seconds();
  volatile double sum = 0;
  while (own_cpu_seconds() - start < 0.5)
    for (int i = 0; i < 1000; ++i) sum = sum + i;
  // Others have the other cores at most; half a second of our own time among them would give more.
  EXPECT_LT(busy.cores(), static_cast<double>(describe_host().cores));
}

}  // namespace
}  // namespace photonproof::inline harness_cells
