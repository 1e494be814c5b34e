// The members of results.json and of a cell's record (reports/record/results.h), as scenes/records/record_note.h
// describes records.
#pragma once

#include <array>
#include <span>
#include <tuple>

#include "reports/record/results.h"
#include "scenes/records/record_note.h"

namespace photonproof::inline reports_record {

inline constexpr std::array status_words{"ok", "timeout", "crash", "bad_image", "unsupported", "not_started"};
inline constexpr std::span<const char* const> failed_status_words = std::span(status_words).subspan(1);
inline constexpr std::array clock_words{"wall", "processor"};
inline constexpr std::array correctness_words{"right", "noisy", "biased", "unknown"};
inline constexpr std::array gate_verdict_words{"pass", "fail", "inconclusive"};
inline constexpr std::array change_words{"regression", "improvement", "unchanged", "inconclusive"};
inline constexpr std::array trust_words{"unbiased", "biased", "external"};

inline std::span<const char* const> names_of(Status) { return status_words; }
inline std::span<const char* const> names_of(Clock) { return clock_words; }
inline std::span<const char* const> names_of(Correctness) { return correctness_words; }
inline std::span<const char* const> names_of(GateVerdict) { return gate_verdict_words; }
inline std::span<const char* const> names_of(Change) { return change_words; }

inline auto elements(Interval& interval) { return std::tie(interval.low, interval.high); }

template <class V>
void describe(V& v, Host& r) {
  v.record("host");
  v.field("cpu", r.cpu);
  v.field("os", r.os);
  v.field("kernel", r.kernel);
  v.field("cores", r.cores, {.least = 1});
  v.field("memory_bytes", r.memory_bytes);
}

template <class V>
void describe(V& v, Estimate& r) {
  v.record("estimate");
  v.field("value", r.value);
  v.maybe("interval", r.interval, {.says = "low, high; of 95 % confidence"});
}

template <class V>
void describe(V& v, ReferenceRecord& r) {
  v.record("reference", "a stored reference and where it came from");
  v.field("file", r.file);
  v.field("image", r.image, {.file = true});
  v.field("picture", r.picture, {.file = true});
  v.field("provenance", r.provenance);
}

template <class V>
void describe(V& v, ExposureRange& r) {
  v.record("exposures", "in stops, evenly spaced");
  v.field("start", r.start);
  v.field("stop", r.stop);
  v.field("count", r.count, {.least = 1});
}

template <class V>
void describe(V& v, SceneRecord& r) {
  v.record("scene");
  v.field("name", r.name, {.filled = true});
  v.maybe("title", r.title, {.says = "name of the scene on pages; absent: its own name"});
  v.field("path", r.path);
  v.field("purpose", r.purpose);
  v.field("width", r.width, {.least = 1});
  v.field("height", r.height, {.least = 1});
  v.field("exposure", r.exposure, {.says = "stops"});
  v.field("reference_label", r.reference_label,
          {.says = "label of the result the scene is compared with; empty when its reference is stored"});
  v.maybe("reference", r.reference);
  v.maybe("reference_doubt", r.reference_doubt, {.says = "why errors against the reference are not errors"});
  v.maybe("hdr_flip_exposures", r.hdr_exposures, {.says = "exposures of hdr_flip; absent where the scene pins none"});
}

template <class V>
void describe(V& v, EngineRecord& r) {
  v.record("engine");
  v.field("name", r.name, {.filled = true});
  v.field("title", r.title);
  v.field("version", r.version);
  v.maybe("trust", r.trust, {.words = trust_words});
}

template <class V>
void describe(V& v, Budget& r) {
  v.record("budget");
  v.field("kind", r.kind, {.filled = true});
  v.field("amount", r.amount, {.least = 0});
}

template <class V>
void describe(V& v, Cell& r) {
  v.record("cell");
  v.field("scene", r.scene, {.filled = true});
  v.field("engine", r.engine, {.filled = true});
  v.field("budget", r.budget);
  v.field("seed", r.seed);
}

template <class V>
void describe(V& v, MetricValue& r) {
  v.record("metric");
  v.field("name", r.name, {.filled = true});
  v.field("value", r.value);
  v.field("parameters", r.parameters);
}

template <class V>
void describe(V& v, CalibrationReading& r) {
  v.record("calibration", "the harness' own calibration workload, beside this cell");
  v.field("workload", r.workload, {.filled = true});
  v.field("threads", r.threads, {.least = 1});
  v.field("seconds", r.seconds, {.says = "processor time of one thread", .above = 0});
}

template <class V>
void describe(V& v, Result& r) {
  v.record("result");
  v.field("cell", r.cell);
  v.field("key", r.key, {.filled = true});
  v.field("status", r.status);
  v.field("detail", r.detail, {.says = "why, when the status is not ok"});
  v.maybe("wall_seconds", r.wall_seconds, {.least = 0});
  v.maybe("cpu_seconds", r.cpu_seconds, {.least = 0});
  v.maybe("peak_bytes", r.peak_bytes);
  v.maybe("instructions", r.instructions);
  v.maybe("calibration", r.calibration);
  v.field("metrics", r.metrics);
  v.field("image", r.image, {.file = true});
  v.maybe("image_checksum", r.image_checksum,
          {.says = "checksum of the image's file as it was measured", .checksum = true});
  v.field("pictures", r.pictures, {.file = true});
  v.field("phases", r.phases, {.least = 0});
  v.field("counts", r.counts);
  v.field("skipped", r.skipped);
  v.field("engine_version", r.engine_version);
  v.field("command", r.command);
  v.field("caveats", r.caveats);
}

template <class V>
void describe(V& v, CorrectnessRecord& r) {
  v.record("correctness", "whether a budget's images show what they should, by the gates' statistics");
  v.field("verdict", r.verdict);
  v.field("sentence", r.sentence);
  v.maybe("whole", r.whole);
  v.maybe("would_see", r.would_see, {.least = 0});
  v.maybe("would_see_in_a_block", r.would_see_in_a_block, {.least = 0});
  v.maybe("block", r.block, {.says = "largest relative error of a block of 8 x 8 pixels"});
  v.maybe("regression_only", r.regression_only);
}

template <class V>
void describe(V& v, ConvergencePoint& r) {
  v.record("point");
  v.field("budget", r.budget);
  v.field("seeds", r.seeds, {.least = 0});
  v.field("seconds", r.seconds);
  v.maybe("relmse", r.relmse);
  v.maybe("spread_of_seeds", r.spread_of_seeds, {.says = "low, high of relmse by its spread over seeds alone"});
  v.maybe("bias2", r.bias2);
  v.maybe("variance", r.variance);
  v.maybe("correctness", r.correctness);
  v.maybe("undefined", r.undefined, {.says = "why a number is not there, by its name"});
}

template <class V>
void describe(V& v, TargetTime& r) {
  v.record("target");
  v.field("relmse", r.relmse);
  v.maybe("seconds", r.seconds);
  v.maybe("more_than", r.more_than);
  v.maybe("at_most", r.at_most);
  v.maybe("undefined", r.undefined);
}

template <class V>
void describe(V& v, Convergence& r) {
  v.record("convergence", "error against time of one engine on one scene");
  v.field("scene", r.scene, {.filled = true});
  v.field("engine", r.engine, {.filled = true});
  v.maybe("clock", r.clock, {.says = "the clock of its seconds; wall if absent"});
  v.field("points", r.points);
  v.maybe("slope", r.slope);
  v.maybe("efficiency", r.efficiency);
  v.maybe("targets", r.targets);
  std::optional<double> only;  // as of version 0.1
  std::optional<Estimate> its_seconds;
  v.older("target_relmse", only, {.says = "one target, of older records"});
  v.older("seconds_to_target", its_seconds);
  if (only && r.targets.empty()) r.targets.push_back({*only, its_seconds});
  v.field("caveats", r.caveats);
  v.maybe("undefined", r.undefined, {.says = "why a number is not there, by its name"});
}

template <class V>
void describe(V& v, RaceRecord::Time& r) {
  v.record("time");
  v.field("engine", r.engine, {.filled = true});
  v.field("seconds", r.seconds, {.least = 0});
  v.maybe("at_most", r.at_most);
  v.maybe("more_than", r.more_than);
  v.maybe("unranked", r.unranked);
  v.maybe("interval", r.interval, {.says = "low, high; of 95 % confidence"});
  v.maybe("ratio", r.ratio, {.says = "to the first engine's seconds"});
  v.maybe("at_least", r.at_least, {.says = "the ratio is a lower bound"});
}

template <class V>
void describe(V& v, RaceRecord::Error& r) {
  v.record("race_error");
  v.field("engine", r.engine, {.filled = true});
  v.field("relmse", r.relmse);
  v.maybe("ratio", r.ratio, {.says = "to the least error"});
}

template <class V>
void describe(V& v, RaceRecord& r) {
  v.record("race", "time of each engine to one error, and error of each at one time; bounds without a rank come last");
  v.field("scene", r.scene, {.filled = true});
  v.field("relmse", r.relmse);
  v.maybe("is_target", r.is_target, {.says = "the suite asks for this error"});
  v.field("times", r.times);
  v.maybe("seconds", r.seconds, {.says = "the time of `errors`"});
  v.maybe("errors", r.errors);
  v.maybe("undecided", r.undecided, {.says = "why no engine is known to be faster"});
}

template <class V>
void describe(V& v, FailingTile& r) {
  v.record("tile");
  v.field("x", r.x, {.least = 0});
  v.field("y", r.y, {.least = 0});
  v.field("width", r.width, {.least = 1});
  v.field("height", r.height, {.least = 1});
  v.field("score", r.score);
  v.field("sentence", r.sentence);
}

template <class V>
void describe(V& v, GateRecord& r) {
  v.record("gate", "the verdict of one gate");
  v.field("name", r.name, {.filled = true});
  v.field("scene", r.scene, {.filled = true});
  v.field("engine", r.engine, {.filled = true});
  v.field("metric", r.metric, {.filled = true});
  v.field("verdict", r.verdict);
  v.field("sentence", r.sentence);
  v.maybe("status", r.status, {.says = "where the engine left no image to be judged", .words = failed_status_words});
  v.maybe("observed", r.observed);
  v.maybe("bound", r.bound);
  v.maybe("would_see", r.would_see, {.least = 0});
  v.maybe("would_see_in_a_block", r.would_see_in_a_block, {.least = 0});
  v.maybe("regression_only", r.regression_only);
  v.maybe("accepted", r.accepted, {.says = "UTC time of the verdict whose images these are"});
  v.field("alpha", r.alpha, {.least = 0, .most = 1});
  v.field("looks", r.looks, {.least = 0});
  v.field("samples", r.samples);
  v.field("seconds", r.seconds, {.least = 0});
  v.field("tiles", r.tiles);
  v.field("image", r.image, {.file = true});
  v.field("pictures", r.pictures, {.file = true});
  v.field("skipped", r.skipped);
  v.field("command", r.command);
}

template <class V>
void describe(V& v, ChangeRecord& r) {
  v.record("change", "this run against an older one");
  v.field("scene", r.scene, {.filled = true});
  v.field("engine", r.engine, {.filled = true});
  v.field("budget", r.budget);
  v.field("quantity", r.quantity, {.filled = true});
  v.field("ratio", r.ratio);
  v.maybe("control", r.control, {.says = "low, high; of 95 % confidence"});
  v.field("change", r.change);
  v.field("sentence", r.sentence);
}

template <class V>
void describe(V& v, Results& r) {
  v.record("photonproof results",
           "One benchmark run: what was measured, how, and on which machine. A quantity that is undefined is absent. "
           "Numbers are finite. Times are in seconds, sizes in bytes; paths are relative to this file.");
  v.version("schema_version", results_schema_version);
  v.field("suite", r.suite);
  v.maybe("title", r.title, {.says = "title of the suite: a report's heading"});
  v.field("created", r.created, {.says = "UTC, ISO 8601"});
  v.field("command", r.command, {.says = "how the whole run is repeated"});
  v.field("host", r.host);
  v.field("versions", r.versions, {.says = "library to version"});
  v.field("scenes", r.scenes);
  v.field("engines", r.engines);
  v.field("results", r.results);
  v.maybe("convergence", r.convergence);
  v.maybe("races", r.races);
  v.maybe("gates", r.gates);
  v.maybe("changes", r.changes);
  v.maybe("findings", r.findings);
  v.maybe("caveats", r.caveats);
}

template <class V>
void describe(V& v, KeptResult& r) {
  v.record("photonproof cell", "One result, as a cell's folder keeps it; its paths are relative to the run's record.");
  v.version("schema_version", results_schema_version);
  v.field("comparison_key", r.comparison_key);
  v.field("result", r.result);
}

}  // namespace photonproof::inline reports_record
