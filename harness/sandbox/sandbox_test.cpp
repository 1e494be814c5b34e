#include "harness/sandbox/sandbox.h"

#include <unistd.h>

#include <csignal>
#include <fstream>

#include "harness/sandbox/control_groups.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_sandbox {
namespace {

using End = ProcessOutcome::End;

class Sandbox : public FolderTest {
 protected:
  void SetUp() override {
    if (const auto why = why_no_sandbox()) GTEST_SKIP() << *why;
    FolderTest::SetUp();
    options_.limits.wall_seconds = 20;
  }
  SandboxOutcome shell(const std::string& script) const { return run_sandboxed({"/bin/sh", "-c", script}, options_); }
  std::string output(const std::string& script) const { return shell(script).process.standard_output; }

  SandboxOptions options_;
};

TEST_F(Sandbox, command_says_its_output_and_its_exit_code) {
  const SandboxOutcome outcome = shell("echo out; echo err >&2; exit 3");
  EXPECT_EQ(outcome.process.standard_output, "out\n");
  EXPECT_EQ(outcome.process.standard_error, "err\n");
  EXPECT_EQ(outcome.process.exit_code, 3);
  EXPECT_EQ(outcome.sentence(), "exited with 3");
  EXPECT_EQ(outcome.limit, "");
}

TEST_F(Sandbox, signal_that_ends_the_command_is_told) {
  EXPECT_EQ(shell("kill -SEGV $$").sentence(), "killed by SIGSEGV");
  EXPECT_EQ(shell("kill -SEGV $$").process.signal, SIGSEGV);
}

TEST_F(Sandbox, command_that_is_not_there_could_not_be_started) {
  const SandboxOutcome outcome = run_sandboxed({"./raytracer"}, options_);
  EXPECT_EQ(outcome.process.end, End::not_started);
  EXPECT_EQ(outcome.sentence(), "could not be started: ./raytracer: No such file or directory");
}

TEST_F(Sandbox, command_is_nobody_and_sees_no_one) {
  EXPECT_NE(output("id -u"), "0\n");
  EXPECT_LE(std::stoi(output("ls -d /proc/[0-9]* | wc -l")), 4);  // bwrap, the shell, ls and wc
  EXPECT_EQ(output("grep CapEff /proc/self/status"), "CapEff:\t0000000000000000\n");
  EXPECT_EQ(output("grep NoNewPrivs /proc/self/status"), "NoNewPrivs:\t1\n");
  EXPECT_EQ(output("cat /proc/net/dev | grep -c :"), "1\n");
}

TEST_F(Sandbox, environment_is_the_options_alone) {
  setenv("GRADER_SECRET", "1", 1);
  options_.environment["LEVEL"] = "2";
  EXPECT_EQ(output("env | sort | grep -v -e ^PWD= -e ^_= -e ^OLDPWD= -e ^SHLVL="),
            "HOME=/tmp\nLANG=C.UTF-8\nLEVEL=2\nPATH=/usr/local/bin:/usr/bin:/bin\nTMPDIR=/tmp\n");
  unsetenv("GRADER_SECRET");
}

TEST_F(Sandbox, folder_is_copied_in_and_a_file_collected) {
  put("in.txt", "seven");
  options_.starts_with = folder_;
  options_.collect = "out.txt";
  std::filesystem::create_directory(folder_ / "to");
  options_.collect_to = folder_ / "to" / "collected";
  const SandboxOutcome outcome = shell("cat in.txt in.txt >out.txt; echo changed >in.txt");
  EXPECT_TRUE(outcome.collected) << outcome.sentence();
  EXPECT_EQ(outcome.collected_kind, "regular file");
  EXPECT_EQ(get("to/collected"), "sevenseven");
  EXPECT_EQ(get("in.txt"), "seven");
}

TEST_F(Sandbox, nothing_is_collected_of_a_command_that_fails) {
  options_.collect = "out.txt";
  options_.collect_to = folder_ / "collected";
  EXPECT_FALSE(shell("echo half >out.txt; exit 1").collected);
  EXPECT_FALSE(has("collected"));
}

TEST_F(Sandbox, tree_is_collected_without_what_is_no_file) {
  std::filesystem::create_directory(folder_ / "to");
  options_.collect = ".";
  options_.collect_to = folder_ / "to";
  const SandboxOutcome outcome = shell("mkdir -p a/b; echo 1 >a/b/c; ln -s b a/link; mkfifo a/pipe; chmod 4711 a/b/c");
  EXPECT_TRUE(outcome.collected);
  EXPECT_EQ(outcome.special, "a/pipe");
  EXPECT_EQ(get("to/a/b/c"), "1\n");
  EXPECT_FALSE(has("to/a/pipe"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "to/a/link"));
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(folder_ / "to/a/b/c").permissions(), static_cast<perms>(0755));
}

TEST_F(Sandbox, mount_is_read_only) {
  put("in.txt", "seven");
  options_.mounts = {{folder_, "/given"}};
  const SandboxOutcome outcome = shell("cat /given/in.txt; echo x >/given/in.txt; echo x >/given/new");
  EXPECT_EQ(outcome.process.standard_output, "seven");
  EXPECT_EQ(get("in.txt"), "seven");
  EXPECT_FALSE(has("new"));
}

TEST_F(Sandbox, time_is_limited) {
  options_.limits.wall_seconds = 0.5;
  const SandboxOutcome outcome = shell("sleep 30");
  EXPECT_EQ(outcome.limit, "time");
  EXPECT_EQ(outcome.sentence(), "killed after 0.5 s (limit)");
}

TEST_F(Sandbox, processor_time_is_limited) {
  options_.limits.cpu_seconds = 1;
  const SandboxOutcome outcome = shell("while :; do :; done");
  EXPECT_EQ(outcome.limit, "processor time");
  EXPECT_EQ(outcome.sentence(), "used more processor time than allowed (limit)");
}

TEST_F(Sandbox, memory_is_limited) {
  options_.limits.memory_bytes = std::uint64_t{100} << 20;
  options_.limits.disk_bytes = std::uint64_t{1} << 20;
  const SandboxOutcome outcome = shell("tail /dev/zero");
  EXPECT_EQ(outcome.limit, "memory");
}

TEST_F(Sandbox, files_are_limited) {
  options_.limits.file_bytes = std::uint64_t{1} << 20;
  EXPECT_EQ(shell("exec head -c 2000000 /dev/zero >big").sentence(), "wrote a file larger than allowed (limit)");
  EXPECT_EQ(shell("head -c 1000000 /dev/zero >small").sentence(), "exited with 0");
}

TEST_F(Sandbox, disk_is_limited_wherever_it_is_written) {
  options_.limits.disk_bytes = std::uint64_t{8} << 20;
  const std::string all = "for to in . /tmp /dev/shm; do head -c 3000000 /dev/zero >$to/part || exit 1; done";
  const SandboxOutcome outcome = shell(all);
  EXPECT_EQ(outcome.limit, "disk");
  EXPECT_EQ(outcome.sentence(), "filled its disk (limit); exited with 1");
  options_.limits.disk_bytes = std::uint64_t{16} << 20;
  EXPECT_TRUE(shell(all).ok());
}

TEST_F(Sandbox, files_without_content_are_limited_too) {
  options_.limits.disk_bytes = std::uint64_t{1} << 20;
  const SandboxOutcome outcome = shell("i=0; while [ $i -lt 3000 ]; do : >$i || exit 1; i=$((i+1)); done");
  EXPECT_EQ(outcome.limit, "disk");
}

TEST_F(Sandbox, log_is_limited) {
  options_.limits.log_bytes = std::uint64_t{1} << 20;
  const SandboxOutcome outcome = shell("yes");
  EXPECT_EQ(outcome.limit, "log");
  EXPECT_EQ(outcome.sentence(), "wrote more than 1 MiB of output (limit)");
}

TEST_F(Sandbox, threads_and_processes_are_limited) {
  options_.limits.processes = 10;
  const SandboxOutcome outcome = shell("for i in 1 2 3 4 5 6 7 8 9 a b c d e f g h i j k; do sleep 5 & done; exit 0");
  EXPECT_FALSE(outcome.process.ok());
}

TEST_F(Sandbox, control_groups_end_with_the_command_and_those_of_killed_graders_are_removed) {
  std::filesystem::path mine;
  {
    const ControlGroups groups(std::uint64_t{1} << 30, 10);
    if (groups.folders().empty()) GTEST_SKIP() << "no control groups can be made here";
    mine = groups.folders()[0];
    EXPECT_TRUE(std::filesystem::exists(mine));
  }
  EXPECT_FALSE(std::filesystem::exists(mine));
  const std::filesystem::path left = mine.parent_path() / "photonproof-999999999-0";  // no process has that number
  std::filesystem::create_directory(left);
  { const ControlGroups groups(std::uint64_t{1} << 30, 10); }
  EXPECT_FALSE(std::filesystem::exists(left));
}

TEST_F(Sandbox, wall_time_is_the_commands_own) {
  const SandboxOutcome outcome = shell("sleep 0.3");
  EXPECT_GE(outcome.process.wall_seconds, 0.3);
  EXPECT_LT(outcome.process.wall_seconds, 10);
}

TEST_F(Sandbox, system_is_told_from_folders_of_graders) {
  EXPECT_TRUE(is_part_of_system("/usr/share/hidden-scenes"));
  EXPECT_TRUE(is_part_of_system("/lib"));
  EXPECT_TRUE(is_part_of_system("/"));
  EXPECT_FALSE(is_part_of_system("/srv/hidden-scenes"));
  EXPECT_FALSE(is_part_of_system(folder_));
}

TEST_F(Sandbox, limits_hold_without_a_sandbox_too) {
  options_.contained = false;
  options_.limits.wall_seconds = 0.5;
  EXPECT_EQ(shell("sleep 30").limit, "time");
  options_.limits.wall_seconds = 20;
  options_.limits.log_bytes = 1000;
  EXPECT_EQ(shell("yes").limit, "log");
  options_.limits.file_bytes = 1000;
  EXPECT_EQ(shell("exec head -c 2000 /dev/zero >big").limit, "file size");
}

}  // namespace
}  // namespace photonproof::inline harness_sandbox
