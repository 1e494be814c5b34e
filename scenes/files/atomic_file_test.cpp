#include "scenes/files/atomic_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_files {
namespace {

namespace fs = std::filesystem;

class atomic_file : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t count_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
};

TEST_F(atomic_file, holds_exactly_the_bytes_written) {
  const std::string bytes("a\0\r\n\xFF", 5);
  write_file_atomically(folder_ / "a.bin", bytes);
  EXPECT_EQ(read_file(folder_ / "a.bin"), bytes);
  write_file_atomically(folder_ / "a.bin", "");
  EXPECT_EQ(read_file(folder_ / "a.bin"), "");
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(atomic_file, keeps_the_old_content_when_the_producer_fails) {
  write_file_atomically(folder_ / "a.txt", "old");
  const auto produce = [](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".txt");
    std::ofstream(temporary) << "half of the new";
    throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(replace_atomically(folder_ / "a.txt", produce), std::runtime_error);
  EXPECT_EQ(read_file(folder_ / "a.txt"), "old");
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(atomic_file, that_was_never_produced_is_an_error) {
  EXPECT_THROW(replace_atomically(folder_ / "a.txt", [](const fs::path&) {}), InputError);
  EXPECT_EQ(count_files(), 0u);
}

TEST_F(atomic_file, reads_no_more_than_its_limit) {
  write_file_atomically(folder_ / "a.txt", "12345");
  EXPECT_EQ(read_file(folder_ / "a.txt", 5), "12345");
  EXPECT_THROW(read_file(folder_ / "a.txt", 4), InputError);
  EXPECT_THROW(read_file(folder_), InputError);
  EXPECT_THROW(read_file(folder_ / "missing"), InputError);
}

TEST_F(atomic_file, temporaries_of_killed_processes_are_removed_and_no_others) {
  // Process numbers end below 2^22 on Linux, so the first is not a process; the second is this process's own.
  std::ofstream(folder_ / ".a.exr.partial-2000000000.checkpoint") << "half";
  std::ofstream(folder_ / (".a.exr.partial-" + std::to_string(getpid()) + ".checkpoint")) << "half";
  std::ofstream(folder_ / ".a.exr.partial-mine.checkpoint") << "a user's";
  std::ofstream(folder_ / ".b.exr.partial-2000000000.checkpoint") << "of another target";
  remove_abandoned_temporaries(folder_ / "a.exr.checkpoint");
  EXPECT_EQ(count_files(), 3u);
  EXPECT_FALSE(fs::exists(folder_ / ".a.exr.partial-2000000000.checkpoint"));
  remove_abandoned_temporaries(folder_ / "missing/a.exr.checkpoint");
}

TEST_F(atomic_file, of_the_longest_name_is_written_and_a_longer_one_refused) {
  const std::string longest(251, 'n');  // and 4 of the extension: file systems end at 255
  write_file_atomically(folder_ / (longest + ".txt"), "x");
  EXPECT_EQ(read_file(folder_ / (longest + ".txt")), "x");
  EXPECT_EQ(count_files(), 1u);
  const fs::path longer = folder_ / (longest + "n.txt");
  EXPECT_EQ(input_error_of([&] { write_file_atomically(longer, "x"); }),
            longer.string() + ": error: cannot be written: File name too long");
  EXPECT_EQ(input_error_of([&] { read_file(longer); }),
            longer.string() + ": error: cannot be read: File name too long");
}

TEST_F(atomic_file, does_not_follow_a_link_under_the_name_of_its_temporary) {
  std::ofstream(folder_ / "victim") << "mine";
  fs::create_symlink("victim", folder_ / (".a.partial-" + std::to_string(getpid()) + ".txt"));
  write_file_atomically(folder_ / "a.txt", "new");
  EXPECT_EQ(read_file(folder_ / "victim"), "mine");
  EXPECT_EQ(read_file(folder_ / "a.txt"), "new");
  EXPECT_FALSE(fs::is_symlink(folder_ / "a.txt"));
}

TEST_F(atomic_file, next_write_removes_what_a_killed_process_left_of_the_same_target) {
  std::ofstream(folder_ / ".a.partial-2000000000.txt") << "half";
  std::ofstream(folder_ / ".a.partial-2000000000-rows.txt") << "half";
  std::ofstream(folder_ / ".b.partial-2000000000.txt") << "of another";
  write_file_atomically(folder_ / "a.txt", "new");
  EXPECT_EQ(count_files(), 2u);
  EXPECT_TRUE(fs::exists(folder_ / ".b.partial-2000000000.txt"));
  remove_all_abandoned_temporaries(folder_);
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(atomic_file, pointer_of_git_lfs_is_named_as_one) {
  put("a.obj", "version https://git-lfs.github.com/spec/v1\noid sha256:0123\nsize 12345\n");
  EXPECT_EQ(input_error_of([&] { read_file(folder_ / "a.obj"); }),
            path("a.obj") + ": error: is a pointer of Git LFS, not the file itself: fetch it with git lfs pull");
}

}  // namespace
}  // namespace photonproof::inline scenes_files
