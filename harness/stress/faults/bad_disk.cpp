#include "harness/stress/faults/bad_disk.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <thread>

#include "scenes/base/timer.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

/// A call that writes. Its file is given by a descriptor or by a path, in the argument of that number.
struct WritingCall {
  long number;
  int descriptor = -1, path = -1;
  int flags = -1;  ///< The flags' argument of an open; only opens for writing are intercepted.
};

constexpr std::array calls {
  WritingCall{SYS_write, 0}, WritingCall{SYS_writev, 0}, WritingCall{SYS_pwrite64, 0}, WritingCall{SYS_fsync, 0},
      WritingCall{SYS_fdatasync, 0}, WritingCall{SYS_ftruncate, 0}, WritingCall{SYS_openat, -1, 1, 2},
      WritingCall{SYS_unlinkat, -1, 1}, WritingCall{SYS_mkdirat, -1, 1}, WritingCall{SYS_renameat2, -1, 1},
#if defined(__x86_64__)
      WritingCall{SYS_open, -1, 0, 1}, WritingCall{SYS_creat, -1, 0}, WritingCall{SYS_unlink, -1, 0},
      WritingCall{SYS_rmdir, -1, 0}, WritingCall{SYS_mkdir, -1, 0}, WritingCall{SYS_rename, -1, 0},
      WritingCall{SYS_renameat, -1, 1},
#endif
};

constexpr std::uint32_t argument(int index) {
  return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + static_cast<std::size_t>(index) * 8);
}

/// A filter that passes all calls except `calls`.
std::vector<sock_filter> filter_program() {
  std::vector<sock_filter> program;
  const auto add = [&](int code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    program.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  };
  add(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (const WritingCall& call : calls) {
    const auto number = static_cast<std::uint32_t>(call.number);
    if (call.flags < 0) {
      add(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1);
    } else {  // an open for reading is not intercepted
      add(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 4);
      add(BPF_LD | BPF_W | BPF_ABS, argument(call.flags));
      add(BPF_JMP | BPF_JSET | BPF_K, O_WRONLY | O_RDWR | O_CREAT, 1, 0);
      add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    }
    add(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF);
  }
  add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  return program;
}

/// The descriptor on which the kernel reports calls; -1 on failure.
int install_filter() {
  std::vector<sock_filter> program = filter_program();
  const sock_fprog all{static_cast<unsigned short>(program.size()), program.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
  return static_cast<int>(syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &all));
}

class Supervisor {
 public:
  Supervisor(const BadDisk& disk, int listener) : disk_(disk), listener_(listener) {}

  /// Runs until no process is left; returns the exit code of `child`.
  int supervise(pid_t child) {
    int code = 0;
    bool child_ended = false;
    while (true) {
      pollfd asked{listener_, POLLIN, 0};
      poll(&asked, 1, 20);
      if ((asked.revents & POLLIN) != 0) answer();
      int status = 0;
      if (!child_ended && waitpid(child, &status, WNOHANG) == child) {
        child_ended = true;
        code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      if (child_ended && ((asked.revents & POLLHUP) != 0 || (asked.revents & POLLIN) == 0)) return code;
    }
  }

 private:
  void answer() {
    seccomp_notif asked{};
    if (ioctl(listener_, SECCOMP_IOCTL_NOTIF_RECV, &asked) != 0) return;  // it was killed meanwhile
    if (disk_.delay_seconds > 0) std::this_thread::sleep_for(std::chrono::duration<double>(disk_.delay_seconds));
    seccomp_notif_resp answered{};
    answered.id = asked.id;
    if (has_failed() && concerns_folder(asked))
      answered.error = -EIO;
    else
      answered.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
    ioctl(listener_, SECCOMP_IOCTL_NOTIF_SEND, &answered);
  }

  bool has_failed() const { return disk_.fails_after_seconds && timer_.seconds() >= *disk_.fails_after_seconds; }

  bool concerns_folder(const seccomp_notif& asked) const {
    const fs::path process = "/proc/" + std::to_string(asked.pid);
    for (const WritingCall& call : calls) {
      if (call.number != asked.data.nr) continue;
      std::error_code ignored;
      fs::path file;
      if (call.descriptor >= 0) {
        const auto descriptor = static_cast<int>(asked.data.args[call.descriptor]);
        file = fs::read_symlink(process / "fd" / std::to_string(descriptor), ignored);
      } else {
        file = text_at(process, asked.data.args[call.path]);
        if (file.is_relative()) file = fs::read_symlink(process / "cwd", ignored) / file;
      }
      const std::string folder = disk_.folder.string() + "/", path = file.lexically_normal().string();
      return path == disk_.folder || path.starts_with(folder);
    }
    return false;
  }

  static std::string text_at(const fs::path& process, std::uint64_t address) {
    std::array<char, 4096> text{};
    const int memory = open((process / "mem").c_str(), O_RDONLY | O_CLOEXEC);
    if (memory < 0) return {};
    // Reads to the end of the page: the next one may not be mapped.
    const std::size_t most = text.size() - address % text.size();
    ssize_t length = pread(memory, text.data(), most, static_cast<off_t>(address));
    const bool goes_on = length > 0 && std::memchr(text.data(), 0, static_cast<std::size_t>(length)) == nullptr;
    if (goes_on) {
      const auto got = static_cast<std::size_t>(length);
      const ssize_t more = pread(memory, text.data() + got, text.size() - got, static_cast<off_t>(address + got));
      if (more > 0) length += more;
    }
    close(memory);
    return length > 0 ? std::string(text.data(), strnlen(text.data(), static_cast<std::size_t>(length))) : "";
  }

  const BadDisk& disk_;
  int listener_;
  Timer timer_;
};

}  // namespace

int run_on_bad_disk(const BadDisk& disk, const std::vector<std::string>& argv) {
  std::vector<char*> words;
  for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  std::array<int, 2> told{};
  if (pipe2(told.data(), O_CLOEXEC) != 0) return no_bad_disk_exit_code;
  // The child shares our table of descriptors, so its listener is ours, too; exec gives it its own table.
  const auto child = static_cast<pid_t>(syscall(SYS_clone, CLONE_FILES | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
  if (child < 0) return no_bad_disk_exit_code;
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // Written before the filter exists, as nobody would answer yet. The kernel gives the lowest free number.
    const int next = fcntl(told[0], F_DUPFD_CLOEXEC, 0);
    close(next);
    [[maybe_unused]] const ssize_t written = write(told[1], &next, sizeof next);
    if (install_filter() != next) _exit(no_bad_disk_exit_code);
    execvp(words[0], words.data());
    _exit(127);
  }
  int listener = -1;
  if (read(told[0], &listener, sizeof listener) != sizeof listener) return no_bad_disk_exit_code;
  return Supervisor(disk, listener).supervise(child);
}

}  // namespace photonproof::inline harness_stress_faults
