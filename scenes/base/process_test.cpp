#include "scenes/base/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <future>
#include <thread>

namespace photonproof::inline scenes_base {
namespace {

using End = ProcessOutcome::End;

ProcessOutcome shell(const std::string& script, const ProcessOptions& options = {}) {
  return run_process({"/bin/sh", "-c", script}, options);
}

// A zombie is dead, whenever init gets round to reaping it.
bool is_alive(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z";
}

bool ends_within_two_seconds(pid_t pid) {
  for (int i = 0; i < 200 && is_alive(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !is_alive(pid);
}

TEST(Process, exit_code_and_both_outputs_are_reported) {
  const ProcessOutcome outcome = shell("echo out; echo err >&2; exit 3");
  EXPECT_EQ(outcome.end, End::exited);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.standard_output, "out\n");
  EXPECT_EQ(outcome.standard_error, "err\n");
  EXPECT_EQ(outcome.sentence(), "exited with 3");
}

TEST(Process, success_is_ok) { EXPECT_TRUE(shell("true").ok()); }

TEST(Process, arguments_pass_without_a_shell) {
  EXPECT_EQ(run_process({"printf", "%s|%s", "a b", "$HOME *"}).standard_output, "a b|$HOME *");
}

TEST(Process, segfault_is_named_by_its_signal) {
  const ProcessOutcome outcome = shell("kill -SEGV $$");
  EXPECT_EQ(outcome.end, End::signalled);
  EXPECT_EQ(outcome.signal, SIGSEGV);
  EXPECT_EQ(outcome.sentence(), "killed by SIGSEGV");
}

TEST(Process, sleep_past_the_wall_limit_is_killed) {
  const ProcessOutcome outcome = shell("sleep 30", {.wall_limit_seconds = 0.2});
  EXPECT_EQ(outcome.end, End::timed_out);
  EXPECT_GE(outcome.wall_seconds, 0.2);
  EXPECT_LT(outcome.wall_seconds, 10);  // far from 30: it was killed, however slow the machine
  EXPECT_LT(outcome.cpu_seconds, 0.2);  // it slept
  EXPECT_EQ(outcome.sentence(), "killed after 0.2 s (limit)");
}

TEST(Process, one_that_ignores_the_interrupt_is_still_killed_at_the_limit) {
  EXPECT_EQ(shell("trap '' INT TERM HUP; sleep 30; sleep 30", {.wall_limit_seconds = 0.2}).end, End::timed_out);
}

TEST(Process, child_and_grandchild_stay_on_the_processor_they_were_given) {
  cpu_set_t allowed;
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  int last = 0;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) last = i;
  ProcessOptions options;
  options.processor = last;
  const ProcessOutcome outcome = run_process({"sh", "-c", "grep Cpus_allowed_list /proc/self/status"}, options);
  EXPECT_EQ(outcome.standard_output, "Cpus_allowed_list:\t" + std::to_string(last) + "\n");
}

TEST(Process, processor_that_does_not_exist_is_not_started) {
  ProcessOptions options;
  options.processor = CPU_SETSIZE - 1;
  EXPECT_EQ(run_process({"true"}, options).end, End::not_started);
}

// A shell's loop of 20000 turns retires more than one of 10; a kernel without counters has no count for either.
TEST(Process, instructions_are_counted_where_the_kernel_does_or_absent) {
  const auto loop = [](const char* turns) {
    return shell("i=0; while [ $i -lt " + std::string(turns) + " ]; do i=$((i+1)); done").instructions;
  };
  const auto few = loop("10"), many = loop("20000");
  EXPECT_EQ(few.has_value(), many.has_value());
  if (few && many) {
    EXPECT_GT(*many, *few + 20000);
  }
}

TEST(Process, several_run_at_once_from_as_many_threads) {
  std::vector<std::future<ProcessOutcome>> runs;
  for (int i = 0; i < 8; ++i)
    runs.push_back(std::async(std::launch::async, [i] { return shell("sleep 0.1; exit " + std::to_string(i)); }));
  for (int i = 0; i < 8; ++i) EXPECT_EQ(runs[static_cast<std::size_t>(i)].get().exit_code, i);
}

TEST(Process, memory_hog_is_killed) {
  // tail keeps one endless line in memory until it ends.
  const ProcessOutcome outcome =
      shell("tail -n 1 /dev/zero", {.wall_limit_seconds = 30, .memory_limit_bytes = std::uint64_t{64} << 20});
  EXPECT_EQ(outcome.end, End::out_of_memory);
  EXPECT_EQ(outcome.sentence(), "used more than 64 MiB of memory (limit)");
  // The limit is of all processes, the peak of the largest: the shell beside it needs some 2 MiB.
  EXPECT_GT(outcome.peak_bytes, std::uint64_t{60} << 20);
}

TEST(Process, memory_of_a_grandchild_counts_towards_the_limit) {
  const ProcessOutcome outcome =
      shell("(tail -n 1 /dev/zero) & wait", {.wall_limit_seconds = 30, .memory_limit_bytes = std::uint64_t{64} << 20});
  EXPECT_EQ(outcome.end, End::out_of_memory);
}

TEST(Process, peak_is_the_childs_own_however_large_the_caller_is) {
  const std::vector<char> ballast(std::size_t{256} << 20, 'x');  // written, hence resident
  EXPECT_EQ(ballast.back(), 'x');
  const ProcessOutcome outcome = shell("sleep 0.2");
  EXPECT_GT(outcome.peak_bytes, std::uint64_t{100} << 10);
  EXPECT_LT(outcome.peak_bytes, std::uint64_t{64} << 20);  // a shell needs some 2 MiB
}

TEST(Process, cpu_time_is_counted_apart_from_wall_time) {
  const ProcessOutcome outcome = shell("i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done; sleep 0.3");
  EXPECT_GT(outcome.cpu_seconds, 0);
  EXPECT_GE(outcome.wall_seconds, 0.3);
}

// The inner shells become the keeper's children when their parent ends.
TEST(Process, cpu_time_of_descendants_that_the_child_did_not_wait_for_is_counted_in_all) {
  const ProcessOutcome outcome =
      shell("( ( i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done; kill -9 $$ ) & ) ; sleep 60");
  EXPECT_EQ(outcome.signal, SIGKILL);
  EXPECT_GT(outcome.all_cpu_seconds, 0.02);
  EXPECT_LT(outcome.cpu_seconds, 0.5 * outcome.all_cpu_seconds);
}

TEST(Process, huge_output_on_both_streams_does_not_deadlock_and_keeps_the_tail) {
  // 4,000,000 characters on each stream, far more than a pipe holds (64 KiB); the last megabyte is kept.
  const ProcessOutcome outcome = shell(
      "head -c 4000000 /dev/zero | tr '\\0' e >&2; head -c 4000000 /dev/zero | tr '\\0' o; printf END; printf DONE >&2",
      {.wall_limit_seconds = 30});
  ASSERT_TRUE(outcome.ok()) << outcome.sentence();
  EXPECT_EQ(outcome.standard_output.size(), std::size_t{1} << 20);
  EXPECT_EQ(outcome.standard_error.size(), std::size_t{1} << 20);
  EXPECT_TRUE(outcome.standard_output.ends_with("ooEND"));
  EXPECT_TRUE(outcome.standard_error.ends_with("eeDONE"));
}

TEST(Process, endless_output_is_still_bounded_in_time) {
  EXPECT_EQ(shell("yes", {.wall_limit_seconds = 0.2}).end, End::timed_out);
}

TEST(Process, missing_program_is_not_started) {
  const ProcessOutcome outcome = run_process({"no-such-program-anywhere"});
  EXPECT_EQ(outcome.end, End::not_started);
  EXPECT_EQ(outcome.sentence(), "could not be started: 'no-such-program-anywhere': No such file or directory");
}

TEST(Process, missing_working_folder_is_named) {
  EXPECT_EQ(run_process({"true"}, {.working_folder = "/no/such/folder"}).sentence(),
            "could not be started: '/no/such/folder': No such file or directory");
}

TEST(Process, working_folder_is_where_the_child_runs) {
  EXPECT_EQ(run_process({"pwd"}, {.working_folder = "/usr"}).standard_output, "/usr\n");
}

TEST(Process, standard_input_is_empty) {
  const ProcessOutcome outcome = run_process({"cat"}, {.wall_limit_seconds = 30});
  EXPECT_TRUE(outcome.ok()) << outcome.sentence();
  EXPECT_EQ(outcome.standard_output, "");
}

TEST(Process, works_in_a_caller_whose_own_streams_are_closed) {
  EXPECT_EXIT(
      {
        close(STDIN_FILENO);
        close(STDOUT_FILENO);
        const ProcessOutcome outcome = shell("cat; echo out; echo err >&2");
        _exit(outcome.standard_output == "out\n" && outcome.standard_error == "err\n" ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Process, standard_error_is_seen_while_it_runs) {
  std::string seen;
  std::chrono::steady_clock::time_point first{};
  ProcessOptions options;
  options.on_stderr = [&](std::string_view chunk) {
    if (seen.empty()) first = std::chrono::steady_clock::now();
    seen += chunk;
  };
  const ProcessOutcome outcome = shell("echo 10% >&2; sleep 0.3; echo 100% >&2", options);
  EXPECT_EQ(seen, "10%\n100%\n");
  EXPECT_EQ(outcome.standard_error, seen);
  EXPECT_GE(std::chrono::steady_clock::now() - first, std::chrono::milliseconds(250));  // the sleep came after it
}

TEST(Process, orphaned_grandchild_dies_with_its_parent) {
  const ProcessOutcome outcome = shell("sleep 60 & echo $!");
  EXPECT_EQ(outcome.end, End::exited);
  EXPECT_LT(outcome.wall_seconds, 10);  // the orphan holds the pipes open without delaying the run
  EXPECT_TRUE(ends_within_two_seconds(static_cast<pid_t>(std::stol(outcome.standard_output))));
}

TEST(Process, grandchild_dies_at_the_limit_too) {
  const ProcessOutcome outcome = shell("sleep 60 & echo $!; wait", {.wall_limit_seconds = 0.3});
  EXPECT_EQ(outcome.end, End::timed_out);
  EXPECT_TRUE(ends_within_two_seconds(static_cast<pid_t>(std::stol(outcome.standard_output))));
}

// A session and, by the second fork, a parent of its own: neither its group nor its ancestry names the child any more.
constexpr const char* daemon = "(setsid sleep 60 </dev/null >/dev/null 2>&1 & echo $!)";

TEST(Process, daemon_dies_with_the_child_that_left_it) {
  const ProcessOutcome outcome = shell(daemon);
  EXPECT_TRUE(outcome.ok()) << outcome.sentence();
  EXPECT_FALSE(is_alive(static_cast<pid_t>(std::stol(outcome.standard_output))));
}

TEST(Process, daemon_dies_at_the_limit) {
  const ProcessOutcome outcome = shell(std::string(daemon) + "; sleep 30", {.wall_limit_seconds = 0.3});
  EXPECT_EQ(outcome.end, End::timed_out);
  EXPECT_LT(outcome.wall_seconds, 10);
  EXPECT_FALSE(is_alive(static_cast<pid_t>(std::stol(outcome.standard_output))));
}

TEST(Process, daemons_of_one_child_die_and_another_child_lives_on) {
  auto other = std::async(std::launch::async, [] { return shell("sleep 1; echo lived"); });
  const ProcessOutcome outcome = shell(daemon);
  EXPECT_FALSE(is_alive(static_cast<pid_t>(std::stol(outcome.standard_output))));
  EXPECT_EQ(other.get().standard_output, "lived\n");
}

TEST(Process, memory_of_a_daemon_counts_towards_the_limit) {
  const ProcessOutcome outcome = shell("(setsid tail -n 1 /dev/zero &) ; sleep 30",
                                       {.wall_limit_seconds = 30, .memory_limit_bytes = std::uint64_t{64} << 20});
  EXPECT_EQ(outcome.end, End::out_of_memory);
}

TEST(Process, output_past_the_limit_ends_the_child_whichever_stream_it_takes) {
  for (const char* script : {"yes", "yes >&2"}) {
    const ProcessOutcome outcome = shell(script, {.wall_limit_seconds = 30, .output_limit_bytes = 1 << 21});
    EXPECT_EQ(outcome.end, End::too_much_output);
    EXPECT_EQ(outcome.sentence(), "wrote more than 2 MiB of output (limit)");
  }
  EXPECT_TRUE(shell("yes | head -c 1000000", {.output_limit_bytes = 1 << 21}).ok());
}

TEST(Process, descriptors_of_the_caller_are_not_the_childs) {
  const int left_open = dup2(open("/dev/null", O_RDONLY), 77);
  ASSERT_EQ(left_open, 77);
  EXPECT_EQ(shell("ls /proc/self/fd | grep -c 77").standard_output, "0\n");
  close(left_open);
}

TEST(Process, interrupt_lets_the_child_finish_by_itself) {
  std::atomic<bool> interrupt = false;
  ProcessOptions options{.wall_limit_seconds = 30, .interrupt = &interrupt};
  options.on_stderr = [&](std::string_view) { interrupt = true; };
  const ProcessOutcome outcome =
      shell("trap 'echo tidy; exit 0' INT; echo ready >&2; while :; do sleep 0.01; done", options);
  EXPECT_EQ(outcome.end, End::interrupted);
  EXPECT_EQ(outcome.standard_output, "tidy\n");
  EXPECT_EQ(outcome.sentence(), "interrupted");
}

TEST(Process, child_that_ignores_the_interrupt_is_killed_two_seconds_later) {
  std::atomic<bool> interrupt = false;
  ProcessOptions options{.wall_limit_seconds = 30, .interrupt = &interrupt};
  options.on_stderr = [&](std::string_view) { interrupt = true; };
  const ProcessOutcome outcome = shell("trap '' INT; echo ready >&2; sleep 30", options);
  EXPECT_EQ(outcome.end, End::interrupted);
  EXPECT_GE(outcome.wall_seconds, 2);
  EXPECT_LT(outcome.wall_seconds, 20);
}

TEST(Process, nothing_starts_once_interrupted) {
  const std::atomic<bool> interrupt = true;
  const ProcessOutcome outcome = shell("echo started", {.interrupt = &interrupt});
  EXPECT_EQ(outcome.end, End::interrupted);
  EXPECT_EQ(outcome.standard_output, "");
}

TEST(Process, child_and_daemon_die_when_the_caller_is_killed) {
  // The caller is a forked copy that prints its child's number and that of a daemon of it into a pipe and is killed by
  // SIGKILL while it waits.
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t caller = fork();
  if (caller == 0) {
    ProcessOptions options;
    options.on_stderr = [&](std::string_view chunk) {
      [[maybe_unused]] auto n = write(ends[1], chunk.data(), chunk.size());
    };
    shell("echo $$ $(setsid sleep 60 </dev/null >/dev/null 2>&1 & echo $!) >&2; exec sleep 60", options);
    _exit(0);
  }
  char text[32] = {};
  ASSERT_GT(read(ends[0], text, sizeof text - 1), 0);
  pid_t child = 0, left = 0;
  ASSERT_EQ(std::sscanf(text, "%d %d", &child, &left), 2);
  EXPECT_TRUE(is_alive(child));
  kill(caller, SIGKILL);
  int status = 0;
  waitpid(caller, &status, 0);
  EXPECT_TRUE(ends_within_two_seconds(child));
  EXPECT_TRUE(ends_within_two_seconds(left));
  close(ends[0]);
  close(ends[1]);
}

}  // namespace
}  // namespace photonproof::inline scenes_base
