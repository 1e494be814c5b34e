#include "harness/cells/run_follower.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "harness/cells/folder_lock.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_cells {
namespace {

using namespace std::chrono_literals;

class RunFollower : public FolderTest {
 protected:
  Follow follow() const { return {folder_ / "results.json", 0.01, &interrupt_}; }
  std::atomic<bool> interrupt_ = false;
};

TEST_F(RunFollower, a_lock_that_nobody_holds_is_no_run) {
  EXPECT_FALSE(is_run_going(folder_ / "missing"));
  EXPECT_FALSE(is_run_going(folder_));
  { const FolderLock lock(folder_); }
  EXPECT_FALSE(is_run_going(folder_));  // the number of this live process is left in the file
  write_file_atomically(folder_ / ".lock", "no number\n");
  EXPECT_FALSE(is_run_going(folder_));
}

TEST_F(RunFollower, a_held_lock_is_a_run_and_another_run_can_begin_after_it) {
  auto lock = std::make_unique<FolderLock>(folder_);
  EXPECT_TRUE(is_run_going(folder_));
  lock.reset();
  EXPECT_FALSE(is_run_going(folder_));
  EXPECT_NO_THROW(FolderLock{folder_});
}

TEST_F(RunFollower, ends_at_once_where_no_run_goes_on) {
  write_file_atomically(folder_ / "results.json", "{}");
  int calls = 0;
  EXPECT_EQ(follow_run(follow(), [&] { ++calls; }), FollowEnd::run_ended);
  EXPECT_EQ(calls, 0);
}

TEST_F(RunFollower, meets_every_state_once_waits_for_the_first_and_ends_with_the_run) {
  auto lock = std::make_unique<FolderLock>(folder_);
  std::atomic<int> calls = 0;
  std::jthread run([&] {
    const auto met = [&](int count) {
      for (int i = 0; i < 1000 && calls < count; ++i) std::this_thread::sleep_for(5ms);
    };
    std::this_thread::sleep_for(50ms);
    write_file_atomically(folder_ / "results.json", "1");
    met(1);
    std::this_thread::sleep_for(50ms);  // the same state is not met again
    write_file_atomically(folder_ / "results.json", "22");
    met(2);
    lock.reset();
  });
  EXPECT_EQ(follow_run(follow(), [&] { ++calls; }), FollowEnd::run_ended);
  EXPECT_EQ(calls, 2);
}

TEST_F(RunFollower, an_interrupt_ends_it_while_the_run_goes_on) {
  const FolderLock lock(folder_);
  std::jthread interrupter([&] {
    std::this_thread::sleep_for(50ms);
    interrupt_ = true;
  });
  Follow slow = follow();
  slow.seconds_between = 60;
  EXPECT_EQ(follow_run(slow, [] {}), FollowEnd::interrupted);
}

}  // namespace
}  // namespace photonproof::inline harness_cells
