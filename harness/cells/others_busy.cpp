#include "harness/cells/others_busy.h"

#include <sys/resource.h>

#include <algorithm>

#include "harness/cells/host.h"

namespace photonproof::inline harness_cells {
namespace {

constexpr double least_seconds = 0.2;

// Processor time of this process and of all its ended children.
double our_cpu_seconds() {
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return own_cpu_seconds() + seconds(children.ru_utime) + seconds(children.ru_stime);
}

}  // namespace

OthersBusy::OthersBusy() : machine_(machine_busy_seconds()), ours_(our_cpu_seconds()) {}

double OthersBusy::cores() const {
  const std::optional<double> now = machine_busy_seconds();
  if (!machine_ || !now || timer_.seconds() < least_seconds) return 0;
  return std::max(0.0, (*now - *machine_ - (our_cpu_seconds() - ours_)) / timer_.seconds());
}

double time_beside_others(double others_cores, double own_cores, int cores) {
  constexpr double tolerated = 0.25, most = 20, worth_a_try = 1.05;
  const double share = others_cores / std::max(1, cores);
  if (share < tolerated) return 1;
  const double left = std::max(1 - share, 1 / most);
  const double factor = 1 + (1 / left - 1) * std::min(1.0, own_cores / left);
  return factor < worth_a_try ? 1 : factor;
}

double time_beside_others(const OthersBusy& others, double cpu_seconds, double wall_seconds) {
  return time_beside_others(others.cores(), cpu_seconds / std::max(wall_seconds, 1e-6), describe_host().cores);
}

}  // namespace photonproof::inline harness_cells
