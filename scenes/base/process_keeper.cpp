#include "scenes/base/process_keeper.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>

namespace photonproof::inline scenes_base {
namespace {

// A process that stays in the kernel for longer, or belongs to another user, is left behind.
constexpr int patience_steps = 300;
constexpr long step_nanoseconds = 10'000'000;

template <class Message>
void tell(int report, const Message& message) {
  while (write(report, &message, sizeof message) < 0 && errno == EINTR) {
  }
}

// The second number behind the name in parentheses, which may hold parentheses itself (proc(5)).
pid_t parent_of(int proc, const char* pid) {
  char path[32], text[1024];
  std::size_t length = 0;
  for (; pid[length] != '\0' && length < 16; ++length) path[length] = pid[length];
  std::memcpy(path + length, "/stat", 6);
  const int file = openat(proc, path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t bytes = read(file, text, sizeof text - 1);
  close(file);
  if (bytes <= 0) return 0;
  text[bytes] = '\0';
  const char* at = std::strrchr(text, ')');
  if (at == nullptr || std::strlen(at) < 5) return 0;
  pid_t parent = 0;
  for (at += 4; *at >= '0' && *at <= '9'; ++at) parent = 10 * parent + (*at - '0');
  return parent;
}

// Orphans come to us one generation after the other, as those above them die.
void kill_children() {
  const int proc = open("/proc", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (proc < 0) return;
  const pid_t self = getpid();
  alignas(dirent64) char buffer[8192];
  for (long bytes = 0; (bytes = syscall(SYS_getdents64, proc, buffer, sizeof buffer)) > 0;) {
    for (long at = 0; at < bytes;) {
      const auto* entry = reinterpret_cast<const dirent64*>(buffer + at);
      at += entry->d_reclen;
      pid_t pid = 0;
      for (const char* digit = entry->d_name; *digit >= '0' && *digit <= '9'; ++digit) pid = 10 * pid + (*digit - '0');
      if (pid > 0 && parent_of(proc, entry->d_name) == self) kill(pid, SIGKILL);
    }
  }
  close(proc);
}

void close_all_but(int a, int b) {
  const unsigned low = static_cast<unsigned>(std::min(a, b)), high = static_cast<unsigned>(std::max(a, b));
#ifdef SYS_close_range
  const bool closed = (low == 0 || syscall(SYS_close_range, 0U, low - 1, 0U) == 0) &&
                      (high - low < 2 || syscall(SYS_close_range, low + 1, high - 1, 0U) == 0) &&
                      syscall(SYS_close_range, high + 1, ~0U, 0U) == 0;
  if (closed) return;
#endif
  const long most = std::min(sysconf(_SC_OPEN_MAX), 65536L);
  for (int descriptor = 0; descriptor < most; ++descriptor)
    if (descriptor != a && descriptor != b) close(descriptor);
}

class Keeper {
 public:
  Keeper(int orders, int report, pid_t child) : orders_(orders), report_(report), child_(child) {
    sigfillset(&all_but_ends_);
    sigdelset(&all_but_ends_, SIGCHLD);
  }

  void run() {
    while (!ended_ && follow_orders()) reap();
    if (!ended_) kill(-child_, SIGKILL);
    for (int steps = 0; reap() && steps < patience_steps; ++steps) {
      kill_children();
      const timespec step{0, step_nanoseconds};
      ppoll(nullptr, 0, &step, &all_but_ends_);  // SIGCHLD wakes it earlier
    }
  }

 private:
  // Waits for an order or the end of a child. False when all is to be killed.
  bool follow_orders() {
    pollfd waiting{orders_, POLLIN, 0};
    if (ppoll(&waiting, 1, nullptr, &all_but_ends_) <= 0) return true;
    KeeperOrder order{};
    const ssize_t length = read(orders_, &order, sizeof order);
    if (length < 0) return errno == EINTR;
    if (length == 0 || order == KeeperOrder::kill) return false;
    kill(-child_, SIGINT);
    return true;
  }

  // Whether children are left that have not ended.
  bool reap() {
    while (true) {
      siginfo_t ended{};
      // WNOWAIT leaves it a zombie, so that its number and its group stay ours until the group is killed.
      if (waitid(P_ALL, 0, &ended, WEXITED | WNOHANG | WNOWAIT) != 0) return false;
      if (ended.si_pid == 0) return true;
      if (ended.si_pid == child_) kill(-child_, SIGKILL);
      KeeperEnd end;
      wait4(ended.si_pid, &end.status, 0, &end.usage);
      if (ended.si_pid != child_) continue;
      ended_ = true;
      tell(report_, end);
    }
  }

  sigset_t all_but_ends_;
  int orders_, report_;
  pid_t child_;
  bool ended_ = false;
};

}  // namespace

void keep_child(int orders, int report, const std::function<void(pid_t keeper)>& become) {
  setpgid(0, 0);
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_SETMASK, &all, nullptr);  // Ctrl-C is the caller's to pass on
  struct sigaction wake {};
  wake.sa_handler = [](int) {};
  sigaction(SIGCHLD, &wake, nullptr);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t keeper = getpid();
  const pid_t child = fork();
  if (child == 0) {
    become(keeper);
    _exit(127);
  }
  tell(report, KeeperStart{child > 0 ? child : 0, child > 0 ? 0 : errno});
  if (child < 0) _exit(1);
  setpgid(child, child);  // also here: the group must exist before anything is sent to it
  close_all_but(orders, report);
  Keeper(orders, report, child).run();
  _exit(0);
}

}  // namespace photonproof::inline scenes_base
