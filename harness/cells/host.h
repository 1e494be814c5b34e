// The machine a measurement was made on, and how busy it was with other things meanwhile.
#pragma once

#include <optional>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_cells {

/// From /proc/cpuinfo, os-release and uname; what cannot be found out is "unknown" or 0.
Host describe_host();

/// Processor time that the whole machine has used since it started, in seconds over all cores, including what a
/// hypervisor withheld. Empty where /proc/stat does not say. Counted in steps of 10 ms.
std::optional<double> machine_busy_seconds();

/// Numbers of the processors that this process may run on, ascending; empty where the system does not say.
std::vector<int> allowed_processors();

/// Processor time this process has used itself (children not counted), in seconds.
double own_cpu_seconds();

}  // namespace photonproof::inline harness_cells
