#include "renderer/core/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace photonproof::inline renderer_core {
namespace {

/// The number at the start of a file; empty for "max", the word for no limit.
std::optional<std::uint64_t> number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t value = 0;
  if (in >> value) return value;
  return std::nullopt;
}

void lower(std::optional<std::uint64_t>& least, std::optional<std::uint64_t> most, std::optional<std::uint64_t> used) {
  if (!most || !used) return;
  const std::uint64_t left = *most - std::min(*most, *used);
  least = least ? std::min(*least, left) : left;
}

/// Lowers `least` to the rest of the process's control group and those above it, wherever a limit is set.
void lower_by_groups(std::optional<std::uint64_t>& least) {
  std::ifstream groups("/proc/self/cgroup");  // lines of number:controllers:path, no controllers in version 2
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && controllers != "memory") continue;
    const bool version_2 = controllers.empty();
    const std::filesystem::path root = version_2 ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    std::filesystem::path group = std::filesystem::path(line.substr(second + 1)).relative_path();
    for (;; group = group.parent_path()) {
      lower(least, number_in(root / group / (version_2 ? "memory.max" : "memory.limit_in_bytes")),
            number_in(root / group / (version_2 ? "memory.current" : "memory.usage_in_bytes")));
      if (group.empty()) break;
    }
  }
}

}  // namespace

std::optional<std::uint64_t> memory_of_meminfo(std::istream& meminfo) {
  for (std::string word; meminfo >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "MemAvailable:" && meminfo >> kilobytes) return kilobytes * 1024;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> available_memory() {
  std::ifstream meminfo("/proc/meminfo");
  std::optional<std::uint64_t> least = memory_of_meminfo(meminfo);
  lower_by_groups(least);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    if (const auto pages = number_in("/proc/self/statm"))
      lower(least, std::uint64_t{limit.rlim_cur}, *pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
  return least;
}

}  // namespace photonproof::inline renderer_core
