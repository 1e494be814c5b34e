#include "harness/cells/host.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

namespace photonproof::inline harness_cells {
namespace {

// The value of the first "key<separator>value" line, without quotes and leading blanks; "unknown" when there is none.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(separator);
    if (!line.starts_with(key) || at == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t\"", at + 1);
    const std::size_t last = line.find_last_not_of(" \t\"\r");
    if (first != std::string::npos) return line.substr(first, last - first + 1);
  }
  return "unknown";
}

// The cores this process may use; a container or taskset can make them fewer than the machine has.
int usable_cores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
}

}  // namespace

Host describe_host() {
  Host host;
  host.cpu = value_in("/proc/cpuinfo", "model name", ':');
  host.os = value_in("/etc/os-release", "PRETTY_NAME", '=');
  utsname name{};
  host.kernel = uname(&name) == 0 ? std::string(name.release) + " " + name.machine : "unknown";
  host.cores = usable_cores();
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_bytes = sysconf(_SC_PAGESIZE);
  if (pages > 0 && page_bytes > 0)
    host.memory_bytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes);
  return host;
}

std::optional<double> machine_busy_seconds() {
  std::ifstream in("/proc/stat");
  std::string word;
  // proc(5): "cpu user nice system idle iowait irq softirq steal ..." in clock ticks.
  std::array<double, 8> ticks{};
  if (!(in >> word) || word != "cpu") return std::nullopt;
  for (double& tick : ticks)
    if (!(in >> tick)) return std::nullopt;
  const auto [user, nice, system, idle, iowait, irq, softirq, steal] = ticks;
  return (user + nice + system + irq + softirq + steal) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double own_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::vector<int> allowed_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<int> numbers;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return numbers;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) numbers.push_back(i);
  return numbers;
}

}  // namespace photonproof::inline harness_cells
