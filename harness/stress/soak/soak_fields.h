// The members of soak.json (harness/stress/soak/soak_record.h), as scenes/records/record_note.h describes records.
#pragma once

#include <array>
#include <cmath>

#include "harness/stress/soak/soak_record.h"
#include "reports/record/results_fields.h"

namespace photonproof::inline harness_stress_soak {

inline constexpr std::array drift_verdict_words{"flat", "grows", "unclear"};
inline std::span<const char* const> names_of(DriftVerdict) { return drift_verdict_words; }

template <class V>
void describe(V& v, SoakSeries& r) {
  v.record("series");
  v.field("name", r.name);
  v.field("unit", r.unit);
  v.field("verdict", r.drift.verdict);
  v.field("growth_a_render", r.drift.slope);
  v.field("bound_a_render", r.bound);
  v.field("warm_up_cycles", r.warm_up);
  v.field("mean", r.drift.mean_value);
  v.when(std::isfinite(r.drift.interval.low), "interval", r.drift.interval);
  v.field("values", r.values);
}

template <class V>
void describe(V& v, SoakKind& r) {
  v.record("kind");
  v.field("scene", r.scene);
  v.field("method", r.method);
  v.when(r.refused.empty(), "checksum", r.checksum);
  v.maybe("refused", r.refused);
}

template <class V>
void describe(V& v, SoakRecord& r) {
  v.record("photonproof soak");
  v.version("schema_version", 1);
  v.field("created", r.created);
  v.field("program", r.program);
  v.field("checksum", r.checksum);
  v.field("command", r.command);
  v.field("host", r.host);
  v.derived("verdict", r.verdict());
  v.derived("sentence", soak_sentence(r));
  v.field("seconds", r.seconds);
  v.field("interrupted", r.interrupted);
  v.object("renders", [&r](auto& renders) {
    renders.field("asked", r.asked);
    renders.field("by_processes", r.by_processes);
    renders.field("within_one", r.within_one);
  });
  v.field("problems", r.problems);
  v.field("series", r.series);
  v.field("kinds", r.kinds);
}

}  // namespace photonproof::inline harness_stress_soak
