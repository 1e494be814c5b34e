#include "renderer/core/available_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <sstream>

namespace photonproof::inline renderer_core {
namespace {

TEST(available_memory, is_what_the_line_of_meminfo_says) {
  std::istringstream some("MemTotal:       24000000 kB\nMemAvailable:   21000000 kB\nBuffers:  5 kB\n");
  EXPECT_EQ(memory_of_meminfo(some), 21000000ull * 1024);
  std::istringstream none("MemTotal:       24000000 kB\n");
  EXPECT_EQ(memory_of_meminfo(none), std::nullopt);
}

TEST(available_memory, is_no_more_than_the_machine_has_nor_than_the_limit_of_address_space) {
  const auto before = available_memory();
  ASSERT_TRUE(before);
  EXPECT_LE(*before, std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE)));
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &old), 0);
  rlimit small = old;
  small.rlim_cur = rlim_t{1} << 30;  // bytes; the process already uses a part of them
  ASSERT_EQ(setrlimit(RLIMIT_AS, &small), 0);
  const auto within = available_memory();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &old), 0);
  ASSERT_TRUE(within);
  EXPECT_LT(*within, std::uint64_t{1} << 30);
}

}  // namespace
}  // namespace photonproof::inline renderer_core
