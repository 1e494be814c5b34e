// fork and exec with pipes: output, errors, one that closes on a successful exec and carries errno otherwise, and those
// of the keeper in between. Everything between fork and exec is async-signal-safe, since the caller may run threads.

#include "scenes/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "scenes/base/instruction_counter.h"
#include "scenes/base/process_keeper.h"
#include "scenes/base/process_memory.h"
#include "scenes/base/timer.h"

namespace photonproof::inline scenes_base {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds tick{20};
constexpr std::chrono::seconds grace_after_interrupt{2};
constexpr std::size_t tail_bytes = std::size_t{1} << 20;
// A sample costs some 10 us for each process of the machine; waiting 50 times that long keeps it under 2 % of a core.
constexpr int sampling_restraint = 50;

// A number as a person writes it: "10", "0.5".
std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string mebibytes(std::uint64_t bytes) { return number(static_cast<double>(bytes) / (1 << 20)) + " MiB"; }

class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() { reset(); }
  int get() const { return value_; }
  void reset() {
    if (value_ >= 0) close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

// Moves a descriptor out of 0..2, which pipe() hands out when the caller itself runs with closed standard streams.
Descriptor above_standard(int descriptor) {
  const Descriptor original(descriptor);
  Descriptor moved(fcntl(descriptor, F_DUPFD_CLOEXEC, 3));
  if (moved.get() < 0) fail("cannot duplicate a file descriptor");
  return moved;
}

struct Pipe {
  Descriptor read_end, write_end;
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("cannot make a pipe");
    read_end = above_standard(ends[0]);
    write_end = above_standard(ends[1]);
  }
};

// Keeps the last tail_bytes of one pipe's output.
class Stream {
 public:
  Stream(Descriptor descriptor, std::string& tail) : descriptor_(std::move(descriptor)), tail_(tail) {
    fcntl(descriptor_.get(), F_SETFL, O_NONBLOCK);
  }
  bool open() const { return descriptor_.get() >= 0; }
  int descriptor() const { return descriptor_.get(); }  // poll ignores a negative one
  std::uint64_t bytes() const { return bytes_; }        // that came, kept or not

  // Reads the available bytes, at most a tail's worth, so that an endless writer cannot delay the check of the limits;
  // closes at the end of file.
  void drain(const std::function<void(std::string_view)>& watcher) {
    std::array<char, 65536> buffer{};
    for (std::size_t taken = 0; open() && taken < tail_bytes;) {
      const ssize_t length = read(descriptor_.get(), buffer.data(), buffer.size());
      if (length < 0 && errno == EINTR) continue;
      if (length < 0 && errno == EAGAIN) return;
      if (length <= 0) {
        descriptor_.reset();
        return;
      }
      const std::string_view chunk(buffer.data(), static_cast<std::size_t>(length));
      taken += chunk.size();
      bytes_ += chunk.size();
      tail_.append(chunk);
      if (tail_.size() > 2 * tail_bytes) trim();
      if (watcher) watcher(chunk);
    }
  }
  void trim() {
    if (tail_.size() > tail_bytes) tail_.erase(0, tail_.size() - tail_bytes);
  }

 private:
  Descriptor descriptor_;
  std::string& tail_;
  std::uint64_t bytes_ = 0;
};

// Data that the child's side of fork needs.
struct Orders {
  char* const* argv;
  const char* folder;
  int processor;  // or -1
  int input, out, err, failure;
  int go;  // becomes readable when the caller has done what must be done before exec
};

// Descriptors of the caller's that exec would hand on: an open file is a way around every limit set on paths.
void keep_standard_descriptors_only() {
#ifdef SYS_close_range
  constexpr unsigned close_on_exec = 1U << 2;  // CLOSE_RANGE_CLOEXEC: the pipe for a failed exec stays open until exec
  if (syscall(SYS_close_range, 3U, ~0U, close_on_exec) == 0) return;
#endif
  const long most = std::min(sysconf(_SC_OPEN_MAX), 65536L);
  for (int descriptor = 3; descriptor < most; ++descriptor) fcntl(descriptor, F_SETFD, FD_CLOEXEC);
}

// The child's side of fork. Never returns; only async-signal-safe calls.
[[noreturn]] void become(const Orders& orders, pid_t parent) {
  const auto& [argv, folder, processor, input, out, err, failure, go] = orders;
  const auto give_up = [&orders] {
    const int code = errno;
    [[maybe_unused]] const ssize_t written = write(orders.failure, &code, sizeof code);
    _exit(127);
  };
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it died before prctl
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal_number : {SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGPIPE}) signal(signal_number, SIG_DFL);
  if (dup2(input, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0) give_up();
  if (folder[0] != '\0' && chdir(folder) != 0) give_up();
  if (processor >= 0) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    if (sched_setaffinity(0, sizeof one, &one) != 0) give_up();
  }
  char word = 0;
  while (read(go, &word, 1) < 0 && errno == EINTR) {
  }
  keep_standard_descriptors_only();
  execvp(argv[0], argv);
  give_up();
  _exit(127);
}

struct Child {
  pid_t keeper = 0;
  int start_error = 0;  // errno of the failed exec, 0 when it runs
  Descriptor out, err, orders, report;
  Descriptor orders_read;  // kept, so that an order to a keeper that has just ended is no SIGPIPE
};

// Whether all of the message came.
template <class Message>
bool read_whole(int descriptor, Message& message) {
  ssize_t length = 0;
  while ((length = read(descriptor, &message, sizeof message)) < 0 && errno == EINTR) {
  }
  return length == sizeof message;
}

void write_byte(int descriptor, char byte) {
  while (write(descriptor, &byte, 1) < 0 && errno == EINTR) {
  }
}

// Waits for the keeper, our child, which ends after all of its children.
void wait_for(pid_t keeper, int& status, rusage& usage) {
  while (wait4(keeper, &status, 0, &usage) < 0 && errno == EINTR) {
  }
}

Child start(const std::vector<std::string>& argv, const ProcessOptions& options, InstructionCounter& counter) {
  std::vector<char*> pointers;
  pointers.reserve(argv.size() + 1);
  for (const std::string& argument : argv) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const std::string folder = options.working_folder.string();
  Pipe out, err, failure, go, orders, report;
  const Descriptor input = above_standard(open("/dev/null", O_RDONLY | O_CLOEXEC));
  const Orders told{pointers.data(),     folder.c_str(),      options.processor.value_or(-1), input.get(),
                    out.write_end.get(), err.write_end.get(), failure.write_end.get(),        go.read_end.get()};
  const std::function<void(pid_t)> child_side = [&told](pid_t keeper) { become(told, keeper); };
  const pid_t keeper = fork();
  if (keeper < 0) fail("cannot start a process");
  if (keeper == 0) {
    for (Descriptor* ours :
         {&out.read_end, &err.read_end, &failure.read_end, &go.write_end, &orders.write_end, &report.read_end})
      ours->reset();
    keep_child(orders.read_end.get(), report.write_end.get(), child_side);
  }
  report.write_end.reset();
  KeeperStart begun;
  if (!read_whole(report.read_end.get(), begun)) begun.error = EAGAIN;
  if (begun.error != 0) {
    int status = 0;
    rusage usage{};
    wait_for(keeper, status, usage);
    errno = begun.error;
    fail("cannot start a process");
  }
  counter.attach(begun.child);
  write_byte(go.write_end.get(), 0);
  failure.write_end.reset();
  Child child;
  child.keeper = keeper;
  read_whole(failure.read_end.get(), child.start_error);
  child.out = std::move(out.read_end);
  child.err = std::move(err.read_end);
  child.orders = std::move(orders.write_end);
  child.orders_read = std::move(orders.read_end);
  child.report = std::move(report.read_end);
  return child;
}

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Watches a started child until it has ended, by itself or by one of the limits.
class Watch {
 public:
  using End = ProcessOutcome::End;
  Watch(const Child& child, const ProcessOptions& options, const Timer& since_start)
      : child_(child), options_(options), since_start_(since_start) {}

  void check(ProcessOutcome& outcome, std::uint64_t output_bytes) {
    if (killed_) return;
    const auto now = Clock::now();
    if (outcome.end == End::interrupted) {
      if (now >= patience_ends_) kill_all();
      return;
    }
    if (options_.interrupt != nullptr && *options_.interrupt) {
      outcome.end = End::interrupted;
      patience_ends_ = now + grace_after_interrupt;
      order(KeeperOrder::interrupt);
    } else if (options_.wall_limit_seconds && since_start_.seconds() >= *options_.wall_limit_seconds) {
      outcome.end = End::timed_out;
      outcome.cause = number(*options_.wall_limit_seconds) + " s";
      kill_all();
    } else if (options_.output_limit_bytes && output_bytes > *options_.output_limit_bytes) {
      outcome.end = End::too_much_output;
      outcome.cause = mebibytes(*options_.output_limit_bytes);
      kill_all();
    } else if ((options_.memory_limit_bytes || options_.samples_peak) && now >= next_sample_) {
      check_memory(outcome);
    }
  }
  std::uint64_t sampled_peak() const { return sampled_peak_; }

 private:
  void check_memory(ProcessOutcome& outcome) {
    const auto before = Clock::now();
    const MemorySample sample = sample_memory(child_.keeper);
    sampled_peak_ = std::max(sampled_peak_, sample.largest_peak_bytes);
    const auto after = Clock::now();
    next_sample_ = after + std::max<Clock::duration>(tick, sampling_restraint * (after - before));
    if (options_.memory_limit_bytes && sample.resident_bytes > *options_.memory_limit_bytes) {
      outcome.end = End::out_of_memory;
      outcome.cause = mebibytes(*options_.memory_limit_bytes);
      kill_all();
    }
  }
  void kill_all() {
    order(KeeperOrder::kill);
    killed_ = true;
  }
  void order(KeeperOrder order) const { write_byte(child_.orders.get(), static_cast<char>(order)); }

  const Child& child_;
  const ProcessOptions& options_;
  const Timer& since_start_;
  Clock::time_point next_sample_{}, patience_ends_{};
  bool killed_ = false;
  std::uint64_t sampled_peak_ = 0;
};

// ru_maxrss starts from the caller's resident set at fork (exec carries it over). It is the child's own peak only where
// it is above that; below, the samples give the peak.
std::uint64_t peak_bytes(const rusage& usage, std::uint64_t inherited, std::uint64_t sampled) {
  const std::uint64_t counted = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return counted > inherited || sampled == 0 ? std::max(counted, sampled) : sampled;
}

void set_natural_end(ProcessOutcome& outcome, int status) {
  if (outcome.end != ProcessOutcome::End::not_started) return;  // a limit or the interrupt ended it
  if (WIFSIGNALED(status)) {
    outcome.end = ProcessOutcome::End::signalled;
    outcome.signal = WTERMSIG(status);
  } else {
    outcome.end = ProcessOutcome::End::exited;
    outcome.exit_code = WEXITSTATUS(status);
  }
}

}  // namespace

ProcessOutcome run_process(const std::vector<std::string>& argv, const ProcessOptions& options) {
  ProcessOutcome outcome;
  if (options.interrupt != nullptr && *options.interrupt) {
    outcome.end = ProcessOutcome::End::interrupted;
    return outcome;
  }
  const std::string folder = options.working_folder.string();
  const std::uint64_t inherited = own_peak_bytes();
  const Timer since_start;
  InstructionCounter counter;
  Child child = start(argv, options, counter);
  int status = 0;
  rusage usage{};
  if (child.start_error != 0) {
    wait_for(child.keeper, status, usage);
    std::error_code ignored;
    const bool bad_folder = !folder.empty() && !std::filesystem::is_directory(folder, ignored);
    outcome.cause = "'" + (bad_folder ? folder : argv[0]) + "': " + std::generic_category().message(child.start_error);
    return outcome;
  }

  Stream out(std::move(child.out), outcome.standard_output);
  Stream err(std::move(child.err), outcome.standard_error);
  Watch watch(child, options, since_start);
  while (true) {
    std::array<pollfd, 3> waiting{pollfd{child.report.get(), POLLIN, 0}, pollfd{out.descriptor(), POLLIN, 0},
                                  pollfd{err.descriptor(), POLLIN, 0}};
    const bool heard = poll(waiting.data(), waiting.size(), static_cast<int>(tick.count())) > 0;
    if (heard && waiting[0].revents != 0) break;
    out.drain({});
    err.drain(options.on_stderr);
    watch.check(outcome, out.bytes() + err.bytes());
  }
  outcome.wall_seconds = since_start.seconds();
  KeeperEnd end;
  const bool told = read_whole(child.report.get(), end);
  wait_for(child.keeper, status, usage);
  outcome.all_cpu_seconds = cpu_seconds(usage);
  if (told) {  // otherwise the keeper was killed, and the child with it
    status = end.status;
    usage = end.usage;
  }
  out.drain({});
  err.drain(options.on_stderr);
  out.trim();
  err.trim();
  set_natural_end(outcome, status);
  outcome.cpu_seconds = cpu_seconds(usage);
  outcome.instructions = counter.count();
  outcome.peak_bytes = peak_bytes(usage, inherited, watch.sampled_peak());
  // A peak between two samples is over the limit, too.
  if (outcome.end == ProcessOutcome::End::exited && options.memory_limit_bytes &&
      outcome.peak_bytes > *options.memory_limit_bytes) {
    outcome.end = ProcessOutcome::End::out_of_memory;
    outcome.cause = mebibytes(*options.memory_limit_bytes);
  }
  return outcome;
}

std::string ProcessOutcome::sentence() const {
  switch (end) {
    case End::exited:
      return "exited with " + std::to_string(exit_code);
    case End::signalled: {
      const char* name = sigabbrev_np(signal);
      return "killed by " + (name != nullptr ? std::string("SIG") + name : "signal " + std::to_string(signal));
    }
    case End::timed_out:
      return "killed after " + cause + " (limit)";
    case End::out_of_memory:
      return "used more than " + cause + " of memory (limit)";
    case End::too_much_output:
      return "wrote more than " + cause + " of output (limit)";
    case End::interrupted:
      return "interrupted";
    case End::not_started:
      break;
  }
  return "could not be started: " + cause;
}

std::string last_line(const std::string& text) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return {};
  const std::size_t before = text.find_last_of("\r\n", last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  return text.substr(first, last - first + 1);
}

}  // namespace photonproof::inline scenes_base
