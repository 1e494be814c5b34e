#include "harness/cells/folder_lock.h"

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_cells {
namespace {

using Lock = FolderTest;

TEST_F(Lock, folder_is_made_and_locked_once) {
  const std::filesystem::path folder = folder_ / "a" / "b";
  const FolderLock lock(folder);
  EXPECT_TRUE(std::filesystem::is_directory(folder));
  EXPECT_EQ(input_error_of([&] { FolderLock second(folder); }),
            folder.string() + ": error: another run is writing here (process " + std::to_string(getpid()) +
                "); wait for it or choose another folder with -o");
}

TEST_F(Lock, lock_ends_with_its_holder) {
  { const FolderLock lock(folder_); }
  EXPECT_EQ(input_error_of([&] { FolderLock second(folder_); }), "no error");
}

TEST_F(Lock, child_processes_do_not_inherit_it) {
  const FolderLock lock(folder_);
  EXPECT_EQ(run_process({"sh", "-c", "ls -l /proc/$$/fd | grep -c '[.]lock'"}).standard_output, "0\n");
}

TEST_F(Lock, folder_that_cannot_be_made_is_an_input_error) {
  put("file", "");
  EXPECT_TRUE(input_error_of([&] {
                FolderLock lock(folder_ / "file" / "x");
              }).starts_with((folder_ / "file" / "x").string() + ": error: cannot be made: "));
}

TEST_F(Lock, file_that_is_no_lock_is_left_as_it_is) {
  const std::string refusal = (folder_ / ".lock").string() +
                              ": error: is not a lock of photonproof's, which is a file of one number: remove it or "
                              "choose another folder with -o";
  const auto refused = [&] { return input_error_of([&] { FolderLock lock(folder_); }); };
  put("victim", "mine");
  std::filesystem::create_symlink("victim", folder_ / ".lock");
  EXPECT_EQ(refused(), refusal);
  std::filesystem::remove(folder_ / ".lock");
  std::filesystem::create_symlink("new", folder_ / ".lock");
  EXPECT_EQ(refused(), refusal);
  EXPECT_FALSE(has("new"));
  std::filesystem::remove(folder_ / ".lock");
  std::filesystem::create_hard_link(folder_ / "victim", folder_ / ".lock");
  EXPECT_EQ(refused(), refusal);
  std::filesystem::remove(folder_ / ".lock");
  EXPECT_EQ(get("victim"), "mine");
  put(".lock", "another program's");
  EXPECT_EQ(refused(), refusal);
  EXPECT_EQ(get(".lock"), "another program's");
  put(".lock", "123\n");  // of a run that has ended
  EXPECT_EQ(refused(), "no error");
}

TEST_F(Lock, says_what_to_do_in_the_words_of_the_verb) {
  const FolderLock lock(folder_);
  EXPECT_TRUE(input_error_of([&] { FolderLock second(folder_, "wait for it"); }).ends_with("; wait for it"));
}

}  // namespace
}  // namespace photonproof::inline harness_cells
