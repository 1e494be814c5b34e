// A small plot of one series over the commits of a history, as an <svg> of its page.
#pragma once

#include <cstddef>
#include <string>

#include "reports/history/history_view.h"

namespace photonproof::reports::inline reports_history {

/// Markers of a plot, at most; a longer series is drawn by the least, median and largest value of neighbours.
inline constexpr std::size_t most_markers = 120;

/// All plots of a history have the same commits on their horizontal axis. Steps are vertical lines with the commit's
/// name and the change. Texts of the history are escaped. `markers`: at most as many are drawn.
std::string history_plot_svg(const History& history, const HistorySeries& series, std::size_t markers);

}  // namespace photonproof::reports::inline reports_history
