#include "scenes/files/scratch_folder.h"

#include <cstdlib>

#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_files {
namespace {

namespace fs = std::filesystem;
using Temporary = FolderTest;

TEST_F(Temporary, folders_of_killed_processes_are_removed_and_no_others) {
  setenv("TMPDIR", folder_.c_str(), 1);
  const auto leave = [&](const std::string& name) { fs::create_directories(folder_ / name / "deep"); };
  // Process numbers end below 2^22 on Linux, so the first is not a process; the second is this process's own.
  leave("photonproof-test-2000000000-AbCdEf");
  leave("photonproof-test-" + std::to_string(getpid()) + "-AbCdEf");
  leave("photonproof-other-2000000000-AbCdEf");
  leave("photonproof-test-mine");
  fs::path own;
  {
    const ScratchFolder folder("test");
    own = folder.path();
    EXPECT_TRUE(fs::is_directory(own));
    EXPECT_EQ(own.parent_path(), folder_);
  }
  unsetenv("TMPDIR");
  EXPECT_FALSE(fs::exists(own));
  EXPECT_FALSE(has("photonproof-test-2000000000-AbCdEf"));
  EXPECT_TRUE(has("photonproof-test-" + std::to_string(getpid()) + "-AbCdEf"));
  EXPECT_TRUE(has("photonproof-other-2000000000-AbCdEf"));
  EXPECT_TRUE(has("photonproof-test-mine"));
}

// As seen by a process of another namespace: no process here has the number in the name.
TEST_F(Temporary, a_folder_whose_maker_lives_in_another_namespace_of_processes_stays) {
  setenv("TMPDIR", folder_.c_str(), 1);
  const fs::path theirs = folder_ / "photonproof-test-2000000000-AbCdEf";
  fs::create_directories(theirs);
  {
    const std::optional<FolderHold> hold = FolderHold::take(theirs);
    ASSERT_TRUE(hold);
    EXPECT_FALSE(FolderHold::take(theirs));
    const ScratchFolder folder("test");
    EXPECT_TRUE(fs::exists(theirs));
    EXPECT_FALSE(FolderHold::take(folder.path()));
  }
  { const ScratchFolder folder("test"); }
  unsetenv("TMPDIR");
  EXPECT_FALSE(fs::exists(theirs));
}

TEST_F(Temporary, a_folder_that_is_gone_is_held_by_nobody) { EXPECT_FALSE(FolderHold::take(folder_ / "none")); }

}  // namespace
}  // namespace photonproof::inline scenes_files
