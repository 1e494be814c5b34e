// Compares two commits of a history. A series changed if its value at the head lies outside what its noise explains.
//
// Noise is known from two sources. A change has to exceed each that is known.
//
// The scatter s of n commits at the base's level: t = |head - mean| / (s sqrt(1 + 1/n)). Its quantile is Student's with
// n - 1 degrees of freedom, as in a prediction interval (Hahn 1969, "Factors for calculating two-sided prediction
// intervals").
//
// Standard errors over seeds of both values. They do not contain the differences of sessions, so times need the
// scatter, too.
//
// The probability of any false change in the whole comparison is at most `false_changes`: it is divided by the number
// of series (Bonferroni).
#pragma once

#include <string>

#include "reports/history/history_comparison.h"
#include "reports/history/history_view.h"

namespace photonproof::inline harness_history {

inline constexpr double false_changes = 0.01;
/// Commits of one level that show the scatter of a series.
inline constexpr std::size_t least_commits = 3;

/// The index of the commit with this name, or of the only one that begins with it. Throws InputError at `where`.
std::size_t find_commit(const reports::History& history, const std::string& where, const std::string& name);

/// Compares two commits of a history whose steps were found. Pictures are left empty.
reports::HistoryComparison compare_commits(const reports::History& history, std::size_t base, std::size_t head);

}  // namespace photonproof::inline harness_history
