// Values, steps and series of a history in words.
#pragma once

#include <string>

#include "reports/history/history_view.h"

namespace photonproof::reports::inline reports_history {

/// At most 10 characters of a hash; other names unchanged.
std::string commit_text(const std::string& name);

/// "2026-11-29 12:33 UTC".
std::string date_text(std::int64_t seconds);

/// A value with its unit: "1.21 s", "0.0164", "2.31 G", "−0.3 %" of a gate.
std::string value_text(const SeriesKey& key, double value);

/// "rose 12 % [9, 15]", "fell 3 %", "moved from +0.1 % to +2.3 %".
std::string change_text(const SeriesKey& key, const HistoryStep& step);

/// Size for sorting: the change's logarithm, or its absolute value.
double size_of(const HistoryStep& step);

/// Whether the step is for the worse. Less is better of all measures; of a gate, values
/// nearer to 0 are, or larger ones of a likeness such as ssim.
bool is_worse(const SeriesKey& key, const HistoryStep& step);

/// "relMSE", "processor time", "gate agreement".
std::string measure_text(const SeriesKey& key);

/// "relMSE of photonmapper on cornell": enough for a sentence.
std::string subject_text(const SeriesKey& key);

/// "relMSE of photonmapper on cornell fell 12 % [9, 15] at 53c5131, and 2 more at this commit"; without steps the
/// number of series that have none.
std::string last_step_sentence(const History& history);

}  // namespace photonproof::reports::inline reports_history
