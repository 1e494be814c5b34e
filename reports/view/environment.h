// The machine of a run, as lines of text.
#pragma once

#include <map>
#include <string>

#include "reports/record/results.h"

namespace photonproof::reports::inline reports_view {

/// "Some CPU, 2 cores, 7.7 GiB, Debian 12, Linux 6.1", without unknown parts.
std::string host_text(const Host& host);

/// The processor and its cores: "AMD EPYC, 2 cores". The dash if neither is known.
std::string machine_text(const Host& host);

/// "embree 3.13.5, oneTBB 2021.8.0", or the dash.
std::string versions_text(const std::map<std::string, std::string>& versions);

}  // namespace photonproof::reports::inline reports_view
