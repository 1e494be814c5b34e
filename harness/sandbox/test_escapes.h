// Attempts of programs to escape: one row each, which reports when it has succeeded.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <fstream>
#include <span>
#include <string>

namespace photonproof::escapes {

/// The attacker's data about the grader, more than a student could know.
struct Target {
  std::string folder;  ///< of the grader: has `secret` with the word `token`, and an empty folder `outside`
  pid_t grader = 0;
  int port = 0;                     ///< TCP and UDP, IPv4 and IPv6
  std::string abstract;             ///< name of an abstract unix socket
  unsigned long token_address = 0;  ///< in the grader's memory
  std::string marker;               ///< a name for things that must not be left behind
};

inline constexpr const char* token = "the-hidden-scene-7f31";

struct Attempt {
  const char* name;
  void (*run)(const Target&);
};

std::span<const Attempt> file_attempts();
std::span<const Attempt> process_attempts();
std::span<const Attempt> network_attempts();
std::span<const Attempt> kernel_attempts();
std::span<const Attempt> greedy_attempts();

/// The attempt has succeeded.
inline void escaped(const std::string& how) {
  std::printf("ESCAPED: %s\n", how.c_str());
  std::fflush(stdout);
}
inline void escaped_if(bool success, const std::string& how) {
  if (success) escaped(how);
}
/// Reads as much of the file as possible. Reading a process's file in /proc fails in the middle when the process ends,
/// and a stream throws then.
inline std::string text_of(const std::string& path) {
  std::string text;
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return text;
  char part[4096];
  for (std::size_t n = std::fread(part, 1, sizeof part, file); n > 0; n = std::fread(part, 1, sizeof part, file))
    text.append(part, n);
  std::fclose(file);
  return text;
}
inline void escaped_if_read(const std::string& path) {
  escaped_if(text_of(path).find(token) != std::string::npos, "read " + path);
}
inline void write_text(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
/// Tries to write where nothing should be writable.
inline void escaped_if_written(const std::string& path) {
  write_text(path, token);
  escaped_if(text_of(path) == token, "wrote " + path);
}

}  // namespace photonproof::escapes
