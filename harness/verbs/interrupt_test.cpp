#include "harness/verbs/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace photonproof::inline harness_verbs {
namespace {

// Each in a process of its own (EXPECT_EXIT forks), since a flag once raised stays up.
void exit_with_flag_after(int signal_number) {
  const std::atomic<bool>& flag = interrupt_flag();
  if (flag) std::_Exit(1);
  std::raise(signal_number);
  std::_Exit(flag ? 42 : 2);
}

class Interrupt : public testing::Test {
 protected:
  // The image library runs threads; forking without an exec beside them is not safe.
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(Interrupt, first_signal_raises_the_flag_and_the_program_goes_on) {
  EXPECT_EXIT(exit_with_flag_after(SIGINT), testing::ExitedWithCode(42), "");
  EXPECT_EXIT(exit_with_flag_after(SIGTERM), testing::ExitedWithCode(42), "");
}

TEST_F(Interrupt, second_signal_ends_the_program) {
  EXPECT_EXIT(
      {
        interrupt_flag();
        std::raise(SIGINT);
        std::raise(SIGINT);
        std::_Exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
