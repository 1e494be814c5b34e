#include "scenes/base/process_memory.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace photonproof::inline scenes_base {
namespace {

// A /proc file in one read; empty when the process has ended meanwhile.
std::string read_proc(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  std::array<char, 4096> buffer{};
  const ssize_t length = read(file, buffer.data(), buffer.size());
  close(file);
  return length > 0 ? std::string(buffer.data(), static_cast<std::size_t>(length)) : std::string{};
}

struct ProcessRow {
  pid_t pid = 0, parent = 0;
  std::uint64_t resident_bytes = 0;
};

// Fields of /proc/<pid>/stat by proc(5): 3 state, 4 ppid, ... 24 rss in pages. The second field is the
// program's name in parentheses, which may hold spaces and parentheses itself, so counting starts behind the last one.
ProcessRow read_row(pid_t pid) {
  const std::string stat = read_proc("/proc/" + std::to_string(pid) + "/stat");
  const auto name_end = stat.rfind(')');
  if (name_end == std::string::npos) return {};
  static const auto page_bytes = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  ProcessRow row;
  row.pid = pid;
  const char* at = stat.c_str() + name_end + 1;
  for (int field = 3; field <= 24; ++field) {
    at = std::strchr(at, ' ');
    if (at == nullptr) return {};
    ++at;
    if (field == 4) row.parent = static_cast<pid_t>(std::strtol(at, nullptr, 10));
    if (field == 24) row.resident_bytes = std::strtoull(at, nullptr, 10) * page_bytes;
  }
  return row;
}

std::vector<ProcessRow> all_processes() {
  std::vector<ProcessRow> rows;
  DIR* proc = opendir("/proc");
  if (proc == nullptr) return rows;
  while (const dirent* entry = readdir(proc)) {
    const auto pid = static_cast<pid_t>(std::strtol(entry->d_name, nullptr, 10));
    if (pid <= 0) continue;
    if (const ProcessRow row = read_row(pid); row.pid != 0) rows.push_back(row);
  }
  closedir(proc);
  return rows;
}

// VmHWM belongs to the program now running: unlike ru_maxrss it excludes the time before exec.
std::uint64_t peak_of(const std::string& pid) {
  const std::string status = read_proc("/proc/" + pid + "/status");
  const auto at = status.find("\nVmHWM:");
  return at == std::string::npos ? 0 : std::strtoull(status.c_str() + at + 7, nullptr, 10) * 1024;
}

}  // namespace

MemorySample sample_memory(pid_t keeper) {
  const std::vector<ProcessRow> rows = all_processes();
  std::set<pid_t> members{keeper};
  // A parent may stand behind its child in the listing (process numbers wrap around), so repeat until nothing changes.
  for (std::size_t before = 0; before != members.size();) {
    before = members.size();
    for (const ProcessRow& row : rows)
      if (members.count(row.parent) != 0) members.insert(row.pid);
  }
  MemorySample sample;
  for (const ProcessRow& row : rows) {
    if (row.pid == keeper || members.count(row.pid) == 0) continue;
    sample.resident_bytes += row.resident_bytes;
    sample.largest_peak_bytes = std::max(sample.largest_peak_bytes, peak_of(std::to_string(row.pid)));
  }
  return sample;
}

std::uint64_t own_peak_bytes() { return peak_of("self"); }

}  // namespace photonproof::inline scenes_base
