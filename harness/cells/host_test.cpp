#include "harness/cells/host.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace photonproof::inline harness_cells {
namespace {

TEST(HostInfo, this_machine_is_described) {
  const Host host = describe_host();
  EXPECT_FALSE(host.cpu.empty());
  EXPECT_FALSE(host.os.empty());
  EXPECT_NE(host.kernel, "unknown");
  EXPECT_GE(host.cores, 1);
  EXPECT_LE(host.cores, static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_GT(host.memory_bytes, std::uint64_t{1} << 24);
}

TEST(HostInfo, busy_time_covers_our_own) {
  const std::optional<double> before = machine_busy_seconds();
  const double own_before = own_cpu_seconds();
  ASSERT_TRUE(before.has_value());
  double sum = 0;
  while (own_cpu_seconds() - own_before < 0.2) sum += 1;
  EXPECT_GT(sum, 0);
  // Both clocks may round a tick of 10 ms away at either end.
  EXPECT_GE(*machine_busy_seconds() - *before, 0.2 - 0.04);
}

}  // namespace
}  // namespace photonproof::inline harness_cells
