// The harness's conclusions (convergence, gates, changes) in words and tables, the same in every format.
#pragma once

#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::reports::inline reports_view {

/// "0.0125 [0.0110, 0.0140]", or the number alone if no interval is known.
std::string estimate_text(const Estimate& estimate, int digits = 3);
/// The same, or the dash.
std::string estimate_text(const std::optional<Estimate>& estimate, int digits = 3);

/// A table with the record's texts, not escaped.
struct PlainTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// The same, or the dash and the reason why there is no such number: "– (one seed)".
std::string estimate_text(const std::optional<Estimate>& estimate, const Reasons& undefined, const char* name);

/// Engine, budget, seeds, verdict, seconds, relMSE, bias², variance, with one row per point. `mark` follows every
/// error.
PlainTable points_table(const std::vector<const Convergence*>& curves, const std::string& mark = {});

/// Engine, slope, efficiency, target, seconds to it, with one row per engine.
PlainTable slopes_table(const std::vector<const Convergence*>& curves);

/// Verdict, gate, engine, metric, observed, bound, samples, looks, α, seconds, with one row per gate.
PlainTable gates_table(const std::vector<const GateRecord*>& gates);

/// ", 12.5 standard errors beyond noise". Empty for a gate on a metric of `compare`, whose tiles have a share of the
/// error in their sentence.
std::string beyond_noise(const GateRecord& gate, const FailingTile& tile);

/// Change, scene, engine, budget, quantity, new / old, A/A control, sentence, with one row per change.
PlainTable changes_table(const std::vector<const ChangeRecord*>& changes);

/// The passes that an engine skipped, with reasons, each once over a scene's cells and gates: "path: stray photons: no
/// glass".
std::vector<std::string> skips_texts(const std::vector<const Result*>& cells,
                                     const std::vector<const GateRecord*>& gates);

}  // namespace photonproof::reports::inline reports_view
