// Starts programs and sends them signals, as a user or a failing machine does; test code only.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace photonproof::inline harness_cells {

/// Discards its standard output and writes its standard error to the file.
inline pid_t start_program(std::vector<std::string> argv, const std::filesystem::path& standard_error) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  std::vector<char*> pointers;
  pointers.reserve(argv.size() + 1);
  for (std::string& word : argv) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  freopen("/dev/null", "w", stdout);
  freopen(standard_error.c_str(), "w", stderr);
  execv(pointers[0], pointers.data());
  _exit(127);
}

/// Waits until the value of `progress()` has changed `steps` times, then `seconds` more. Then sends the signal, unless
/// the program has ended. Returns the status of wait. Counting steps ensures progress on a busy machine.
template <class Progress>
int signal_after(pid_t pid, int signal_number, int steps, double seconds, const Progress& progress) {
  int status = 0;
  auto last = progress();
  while (steps > 0) {
    if (waitpid(pid, &status, WNOHANG) == pid) return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (const auto now = progress(); now != last) {
      last = now;
      --steps;
    }
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  kill(pid, signal_number);
  waitpid(pid, &status, 0);
  return status;
}

}  // namespace photonproof::inline harness_cells
