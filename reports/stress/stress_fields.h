// The members of stress.json (reports/stress/stress_record.h), as scenes/records/record_note.h describes records.
#pragma once

#include <array>

#include "reports/stress/stress_record.h"
#include "scenes/records/record_note.h"

namespace photonproof::inline reports_stress {

inline constexpr std::array level_outcome_words{"right",     "degraded",       "refused",
                                                "undecided", "silently wrong", "crashed"};
inline std::span<const char* const> names_of(LevelOutcome) { return level_outcome_words; }

template <class V>
void describe(V& v, StressLevel& r) {
  v.record("rung");
  v.field("height", r.height);
  v.field("outcome", r.outcome);
  v.field("sentence", r.sentence);
  v.field("seconds", r.seconds, {.says = "time of its renders by the wall clock"});
  v.maybe("would_see", r.would_see,
          {.says = "the relative error of the mean that would have been seen, probability 0.99"});
  v.maybe("picture", r.picture, {.says = "PNG", .file = true});
  v.maybe("expected", r.expected, {.says = "PNG", .file = true});
}

template <class V>
void describe(V& v, StressSweep& r) {
  v.record("ladder", "one sweep run by one engine, up to the first level that fails or is refused");
  v.field("feature", r.feature);
  v.field("climb", r.sweep_run);
  v.field("engine", r.engine);
  v.field("measure", r.measure, {.says = "the meaning of a height: a unit of length of 10^k"});
  v.field("wanted", r.wanted, {.says = "the height that should be right"});
  v.field("rungs", r.levels);
  v.maybe("not_climbed", r.not_swept, {.says = "why the engine does not render the feature"});
  v.derived("right_up_to", r.right_up_to());
  v.derived("breakdown", r.breakdown() ? std::optional(r.breakdown()->height) : std::nullopt);
}

template <class V>
void describe(V& v, StressRecord& r) {
  v.record("photonproof stress",
           "Where each feature breaks in each engine, and whether that is reported. Paths are relative to this file.");
  v.version("schema_version", 1);
  v.field("created", r.created, {.says = "UTC, ISO 8601"});
  v.field("program", r.program, {.says = "its version"});
  v.field("checksum", r.checksum, {.says = "checksum of the program's file"});
  v.field("host", r.host);
  v.field("command", r.command);
  v.field("quick", r.quick);
  v.field("interrupted", r.interrupted);
  v.field("seconds", r.seconds);
  v.field("ladders", r.sweeps);
}

}  // namespace photonproof::inline reports_stress
