#include "harness/stress/faults/tested_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/timer.h"

extern char** environ;

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Settings of posix_spawn: files and the process group.
class SpawnSettings {
 public:
  explicit SpawnSettings(const fs::path& folder) {
    posix_spawn_file_actions_init(&files);
    const int write = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, (folder / "out.txt").c_str(), write, 0666);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, (folder / "err.txt").c_str(), write, 0666);
    posix_spawnattr_init(&attributes);
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
};

}  // namespace

bool ProcessEnd::is_orderly() const {
  const bool documented = (code >= 0 && code <= 3) || code == 130;
  return !hung && exited && documented;
}

std::string ProcessEnd::sentence() const {
  if (hung) return "did not end by itself";
  if (!exited) return std::string("was killed by signal ") + std::to_string(signal) + " (" + strsignal(signal) + ")";
  const std::string message = last_line(standard_error);
  return "exited with " + std::to_string(code) + (message.empty() ? "" : ": " + message);
}

TestedProcess::TestedProcess(const std::vector<std::string>& argv, const fs::path& folder) : folder_(folder) {
  const SpawnSettings settings(folder);
  std::vector<char*> words;
  for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const int problem = posix_spawnp(&pid_, words[0], &settings.files, &settings.attributes, words.data(), environ);
  if (problem != 0) throw InputError(argv[0], "cannot be started: " + std::generic_category().message(problem));
}

TestedProcess::~TestedProcess() {
  if (!end_) end(0);
}

void TestedProcess::send(int signal_number) const {
  if (!end_) kill(pid_, signal_number);
}

const ProcessEnd& TestedProcess::ended_with(int status, bool hung) {
  ProcessEnd end;
  end.hung = hung;
  end.exited = WIFEXITED(status);
  end.code = end.exited ? WEXITSTATUS(status) : 0;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.standard_error = text_of(folder_ / "err.txt");
  return end_.emplace(std::move(end));
}

std::optional<ProcessEnd> TestedProcess::wait(double seconds) {
  if (end_) return end_;
  const Timer timer;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) != pid_) {
    const double left = seconds - timer.seconds();
    if (left <= 0) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.001)));
  }
  return ended_with(status, false);
}

ProcessEnd TestedProcess::end(double seconds) {
  if (const auto end = wait(seconds)) return *end;
  kill(-pid_, SIGKILL);
  int status = 0;
  waitpid(pid_, &status, 0);
  return ended_with(status, true);
}

bool runs_with(const std::string& text) {
  std::error_code error;
  for (fs::directory_iterator entry("/proc", error), none; !error && entry != none; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (name == std::to_string(getpid())) continue;
    std::string words = text_of(entry->path() / "cmdline");
    std::replace(words.begin(), words.end(), '\0', ' ');
    if (words.find(text) != std::string::npos) return true;
  }
  return false;
}

}  // namespace photonproof::inline harness_stress_faults
