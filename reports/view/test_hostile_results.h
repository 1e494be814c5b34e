// The sample record with texts that are meant to break a format.
#pragma once

#include <string>

#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_view {

/// Replaces every text of the record by `evil`; names keep a distinct part.
inline Results hostile(const std::string& evil) {
  Results results = sample_conclusions();
  results.suite = results.command = results.created = evil;
  for (SceneRecord& scene : results.scenes) {
    const std::string old = scene.name;
    scene.name += evil;
    for (Result& result : results.results) {
      if (result.cell.scene == old) result.cell.scene = scene.name;
    }
    for (GateRecord& gate : results.gates) {
      if (gate.scene == old) gate.scene = scene.name;
    }
  }
  for (Result& result : results.results) {
    result.detail = result.command = evil;
    result.cell.engine += evil;
    result.cell.budget.kind += evil;
    result.metrics.push_back({evil, 1, evil});
    result.counts[evil] = 1;
  }
  for (GateRecord& gate : results.gates) {
    gate.name += evil;
    gate.metric = gate.sentence = gate.command = evil;
    for (FailingTile& tile : gate.tiles) tile.sentence = evil;
  }
  for (ChangeRecord& change : results.changes) change.sentence = change.quantity = evil;
  for (Convergence& curve : results.convergence) curve.engine += evil;
  return results;
}

/// Symbols that reports write, and what a name may hold: é has a command, the two Chinese characters have none.
inline constexpr const char* symbols =
    "− × · ± ≤ ≥ ≈ ≠ √ ∞ → ← ↑ ↓ α ρ σ χ µ ° † – — … ’ “ ” \u202F 10⁻³ é \u4E2D\u6587 ✓ ✕ ▲";

}  // namespace photonproof::reports::inline reports_view
