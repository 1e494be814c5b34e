// Other processes: seeing, reading and killing them, and outliving the run.
#include <fcntl.h>
#include <sched.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "harness/sandbox/test_escapes.h"

namespace photonproof::escapes {
namespace {

std::string proc_of(const Target& t, const char* file) { return "/proc/" + std::to_string(t.grader) + "/" + file; }

// Sleeps with the marker in its command line, by which the test finds it outside.
[[noreturn]] void live_on(const Target& t) {
  for (int signal_number = 1; signal_number < 32; ++signal_number) signal(signal_number, SIG_IGN);
  execl("/bin/sh", "sh", "-c", "trap '' HUP INT TERM; sleep 60; sleep 60", t.marker.c_str(), nullptr);
  _exit(1);
}

void leave_daemon(const Target& t) {
  if (fork() != 0) {
    usleep(50'000);
    return;
  }
  setsid();
  for (int descriptor = 0; descriptor < 3; ++descriptor) close(descriptor);
  if (fork() == 0) live_on(t);
  _exit(0);
}

// Each copy is another process by the time anyone looks for it.
void leave_a_process_that_always_forks(const Target& t) {
  if (fork() != 0) {
    usleep(50'000);
    return;
  }
  setsid();
  for (int round = 0; round < 2000; ++round) {
    if (fork() != 0) _exit(0);
    setpgid(0, 0);
    usleep(100);
  }
  live_on(t);
}

void read_memory(const Target& t) {
  char text[64] = {};
  iovec here{text, std::strlen(token)}, there{reinterpret_cast<void*>(t.token_address), std::strlen(token)};
  escaped_if(process_vm_readv(t.grader, &here, 1, &there, 1, 0) > 0 && std::string(text) == token,
             "read the grader's memory");
  const int memory = open(proc_of(t, "mem").c_str(), O_RDWR);
  escaped_if(memory >= 0 && pread(memory, text, 8, static_cast<off_t>(t.token_address)) == 8, "opened its memory");
}

void kill_everybody(const Target&) {
  signal(SIGTERM, SIG_IGN);
  kill(-1, SIGTERM);
  kill(-1, SIGKILL);
}

void kill_what_contains_us(const Target&) {
  for (const pid_t pid : {1, 2, getppid()}) kill(pid, SIGKILL);
  kill(0, SIGSTOP);
}

constexpr Attempt rows[] = {
    {"see_the_grader", [](const Target& t) { escaped_if(!text_of(proc_of(t, "cmdline")).empty(), "sees the grader"); }},
    {"read_the_graders_environment", [](const Target& t) { escaped_if_read(proc_of(t, "environ")); }},
    {"read_any_environment",
     [](const Target&) {
       for (int pid = 1; pid < 70000; ++pid) escaped_if_read("/proc/" + std::to_string(pid) + "/environ");
     }},
    {"read_the_graders_descriptors",
     [](const Target& t) {
       for (int descriptor = 3; descriptor < 64; ++descriptor)
         escaped_if_read(proc_of(t, ("fd/" + std::to_string(descriptor)).c_str()));
     }},
    {"enter_the_graders_folder",
     [](const Target& t) { escaped_if(chdir(proc_of(t, "cwd").c_str()) == 0, "entered the grader's folder"); }},
    {"read_the_graders_memory", read_memory},
    {"trace_the_grader",
     [](const Target& t) { escaped_if(ptrace(PTRACE_SEIZE, t.grader, nullptr, nullptr) == 0, "traces the grader"); }},
    {"signal_the_grader", [](const Target& t) { escaped_if(kill(t.grader, SIGUSR1) == 0, "the grader got a signal"); }},
    {"lower_the_graders_priority",
     [](const Target& t) {
       escaped_if(setpriority(PRIO_PROCESS, static_cast<id_t>(t.grader), 1) == 0, "the grader is slower");
     }},
    {"bind_the_grader_to_one_processor",
     [](const Target& t) {
       cpu_set_t set;
       escaped_if(
           sched_getaffinity(t.grader, sizeof set, &set) == 0 && sched_setaffinity(t.grader, sizeof set, &set) == 0,
           "the grader's processors are ours to choose");
     }},
    {"lower_the_graders_limits",
     [](const Target& t) {
       rlimit limit{};
       escaped_if(prlimit(t.grader, RLIMIT_NOFILE, nullptr, &limit) == 0, "the grader's limits are known");
     }},
    {"kill_the_grader",
     [](const Target& t) { escaped_if(kill(t.grader, SIGKILL) == 0, "the grader was sent SIGKILL"); }},
    {"kill_everybody", kill_everybody},
    {"kill_what_contains_us", kill_what_contains_us},
    {"leave_a_daemon", leave_daemon},
    {"leave_a_process_that_always_forks", leave_a_process_that_always_forks},
};

}  // namespace

std::span<const Attempt> process_attempts() { return rows; }

}  // namespace photonproof::escapes
