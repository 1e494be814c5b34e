// The machine of a measurement, and how busy it was with other work meanwhile.
#pragma once

#include <optional>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_cells {

/// Reads /proc/cpuinfo, os-release and uname; unknown values are "unknown" or 0.
Host describe_host();

/// Processor time of the whole machine since it started, in seconds over all cores, in steps of 10 ms. It includes time
/// that a hypervisor withheld. Empty if /proc/stat lacks it.
std::optional<double> machine_busy_seconds();

/// Numbers of the processors that this process may run on, ascending; empty if the system does not report them.
std::vector<int> allowed_processors();

/// Processor time this process has used itself (children not counted), in seconds.
double own_cpu_seconds();

}  // namespace photonproof::inline harness_cells
