#include "harness/submissions/submission.h"

#include <sys/stat.h>

#include <fstream>

#include "harness/sandbox/sandbox.h"
#include "harness/submissions/submission_tree.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;

class Intake : public FolderTest {
 protected:
  void SetUp() override {
    if (const auto why = why_no_sandbox()) GTEST_SKIP() << *why;
    FolderTest::SetUp();
    fs::create_directories(folder_ / "given/team/src");
    put("given/team/Makefile", "all:\n");
    put("given/team/src/a.c", "int a;\n");
    fs::create_symlink("src/a.c", folder_ / "given/team/link.c");
  }
  // Runs a shell script in the folder `given`.
  void shell(const std::string& script) const {
    const ProcessOutcome outcome = run_process({"/bin/sh", "-ec", script}, {.working_folder = folder_ / "given"});
    ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  }
  // Empty, or the error.
  std::string taken(const std::string& name) {
    fs::remove_all(folder_ / "taken");
    try {
      take_in({"team", folder_ / "given" / name}, folder_ / "taken", limits_);
    } catch (const SubmissionError& error) {
      EXPECT_FALSE(has("taken"));
      return error.what();
    }
    return "";
  }
  void expect_all() const {
    EXPECT_EQ(get("taken/Makefile"), "all:\n");
    EXPECT_EQ(get("taken/src/a.c"), "int a;\n");
    EXPECT_EQ(fs::read_symlink(folder_ / "taken/link.c"), "src/a.c");
  }
  IntakeLimits limits_;
};

TEST_F(Intake, folder_is_copied) {
  EXPECT_EQ(taken("team"), "");
  expect_all();
}

TEST_F(Intake, archives_of_all_kinds_are_unpacked_and_their_only_folder_entered) {
  shell(
      "tar cf a.tar team; tar czf a.tgz team; tar cjf a.tar.bz2 team; tar cJf a.tar.xz team; tar c --zstd -f a.tar.zst "
      "team;"
      "bsdtar -c --format zip -f a.zip team");
  for (const char* name : {"a.tar", "a.tgz", "a.tar.bz2", "a.tar.xz", "a.tar.zst", "a.zip"}) {
    EXPECT_EQ(taken(name), "") << name;
    expect_all();
  }
}

TEST_F(Intake, archive_without_a_folder_around_it_is_unpacked_as_it_is) {
  shell("tar cf a.tar -C team .");
  EXPECT_EQ(taken("a.tar"), "");
  expect_all();
}

TEST_F(Intake, git_bundle_is_checked_out_without_its_history) {
  shell(
      "cd team; git init -q -b work; git add .; git -c user.name=a -c user.email=a@b commit -qm a;"
      "git bundle create -q ../a.bundle --all; git bundle create -q ../b.bundle work");
  for (const char* name : {"a.bundle", "b.bundle"}) {
    EXPECT_EQ(taken(name), "") << name;
    expect_all();
    EXPECT_FALSE(has("taken/.git"));
  }
}

TEST_F(Intake, members_that_lead_outside_are_refused) {
  shell(
      "tar cPf absolute.tar --transform 's,^team/M,/tmp/M,' team; tar cPf above.tar --transform "
      "'s,^team/M,team/../../M,' team");
  EXPECT_EQ(taken("absolute.tar"), "/tmp/Makefile would be unpacked outside of it");
  EXPECT_EQ(taken("above.tar"), "team/../../Makefile would be unpacked outside of it");
}

TEST_F(Intake, links_that_lead_outside_are_refused) {
  shell("ln -s /etc/passwd team/secret");
  EXPECT_EQ(taken("team"), "secret is a link to /etc/passwd, outside of the submission");
  shell("tar cf a.tar team; ln -sf ../../../secret team/secret");
  EXPECT_EQ(taken("a.tar"), "team/secret is a link to /etc/passwd, outside of the submission");
  EXPECT_EQ(taken("team"), "secret is a link to ../../../secret, outside of the submission");
  // As a text the link stays inside, but `loop` is the submission's own folder.
  shell("rm team/secret; mkdir -p team/x/y; ln -s ../.. team/x/y/loop; ln -s loop/../file team/x/y/out");
  EXPECT_EQ(taken("team"), "x/y/out is a link to loop/../file, outside of the submission");
}

TEST_F(Intake, pipes_sockets_and_devices_are_refused) {
  shell("mkfifo team/pipe; tar cf a.tar team");
  EXPECT_EQ(taken("team"), "pipe is a device, a pipe or a socket");
  EXPECT_EQ(taken("a.tar"), "team/pipe is a device, a pipe or a socket");
}

TEST_F(Intake, bombs_are_refused) {
  limits_.bytes = std::uint64_t{4} << 20;
  limits_.files = 500;
  shell(
      "head -c 100000000 /dev/zero >team/zeros; tar czf a.tgz team; bsdtar -c --format zip -f a.zip team; rm "
      "team/zeros;"
      "mkdir team/many; cd team/many; i=0; while [ $i -lt 600 ]; do : >$i; i=$((i+1)); done");
  EXPECT_LT(fs::file_size(folder_ / "given/a.tgz"), 200000u);
  EXPECT_EQ(taken("a.tgz"), "it is more than 4 MiB or 500 files when unpacked");
  EXPECT_EQ(taken("a.zip"), "it is more than 4 MiB or 500 files when unpacked");
  EXPECT_EQ(taken("team"), "it has more than 500 files");
}

TEST_F(Intake, what_is_no_submission_is_refused) {
  put("given/a.zip", "hello");
  EXPECT_EQ(taken("a.zip"), "it is no folder, .zip, .tar, .tar.gz, .tar.bz2, .tar.xz, .tar.zst or git bundle");
  shell("tar czf whole.tgz team; head -c 100 whole.tgz >half.tgz; mkdir empty");
  EXPECT_THAT(taken("half.tgz"), testing::StartsWith("it cannot be unpacked: "));
  EXPECT_EQ(taken("empty"), "it is empty");
  EXPECT_THROW(taken("none"), InputError);
}

TEST_F(Intake, source_is_not_changed_and_rights_of_files_do_not_matter) {
  shell("chmod 400 team/Makefile; chmod 500 team/src; chmod 6755 team/src/a.c");
  EXPECT_EQ(taken("team"), "");
  struct stat about {};
  stat((folder_ / "taken/src/a.c").c_str(), &about);
  EXPECT_EQ(about.st_mode & 07777U, 0755U);
  stat((folder_ / "given/team/Makefile").c_str(), &about);
  EXPECT_EQ(about.st_mode & 07777U, 0400U);
  shell("chmod -R u+rwX team");
}

TEST_F(Intake, staffs_files_replace_links_and_folders_without_following_them) {
  fs::create_directories(folder_ / "staff/include");
  put("staff/config.h", "staff");
  put("staff/include/b.h", "staff");
  fs::create_directories(folder_ / "outside");
  put("outside/b.h", "mine");
  put("outside/file", "mine");
  const fs::path team = folder_ / "given/team";
  fs::create_symlink(folder_ / "outside/file", team / "config.h");
  fs::create_symlink(folder_ / "outside", team / "include");
  overwrite_files(folder_ / "staff", team);
  EXPECT_EQ(get("given/team/config.h"), "staff");
  EXPECT_EQ(get("given/team/include/b.h"), "staff");
  EXPECT_EQ(get("outside/file"), "mine");
  EXPECT_EQ(get("outside/b.h"), "mine");
  fs::remove(team / "config.h");
  fs::create_directories(team / "config.h/below");
  fs::remove_all(team / "include");
  put("given/team/include", "a file");
  put("outside/name", "mine");
  overwrite_files(folder_ / "staff", team);
  EXPECT_EQ(get("given/team/config.h"), "staff");
  EXPECT_EQ(get("given/team/include/b.h"), "staff");
}

TEST_F(Intake, hard_link_of_a_staff_file_keeps_its_other_name) {
  fs::create_directories(folder_ / "staff");
  put("staff/config.h", "staff");
  put("given/team/config.h", "mine");
  fs::create_hard_link(folder_ / "given/team/config.h", folder_ / "other");
  overwrite_files(folder_ / "staff", folder_ / "given/team");
  EXPECT_EQ(get("other"), "mine");
}

}  // namespace
}  // namespace photonproof::inline harness_submissions
