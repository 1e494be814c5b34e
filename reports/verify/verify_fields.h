// The members of verify.json (reports/verify/verify_record.h), as scenes/records/record_note.h describes records.
#pragma once

#include <cmath>

#include "reports/verify/verify_record.h"
#include "scenes/records/record_note.h"

namespace photonproof::inline reports_verify {

inline constexpr std::array verify_status_words{"ok", "timeout", "crash", "bad_image", "unsupported", "not_started"};
inline constexpr std::array verify_probe_kinds{"light", "material", "camera", "medium"};
inline constexpr std::array verify_probe_verdicts{"right", "wrong", "not rendered"};
inline constexpr std::array verify_pair_verdicts{"agree", "differ", "undecided"};
inline constexpr std::array verify_scene_verdicts{"agree",        "differ", "stale reference", "cannot tell which",
                                                  "inconclusive", "failed"};

/// Left out where it is undefined or not finite.
template <class V>
void describe_finite(V& v, const char* name, std::optional<double>& value, const RecordNote& note = {}) {
  v.when(value && std::isfinite(*value), name, value, note);
}

template <class V>
void describe(V& v, VerifyEngineRecord& r) {
  v.record("engine");
  v.field("name", r.name);
  v.field("title", r.title);
  v.field("version", r.version);
  v.field("problem", r.problem, {.says = "why it cannot be used; empty where it can"});
}

template <class V>
void describe(V& v, VerifyPicture& r) {
  v.record("picture");
  v.field("engine", r.engine);
  v.field("status", r.status, {.words = verify_status_words});
  v.field("detail", r.detail);
  v.field("command", r.command);
  v.field("seconds", r.seconds, {.least = 0});
  v.field("samples", r.samples, {.says = "a pixel; 0 where the budget does not count them"});
  v.field("mean", r.mean, {.says = "mean of the image, by channel"});
  v.field("declared_whole", r.declared_whole, {.says = "known relative error of the mean", .least = 0});
  v.field("declared_block", r.declared_block, {.says = "known error of a block of 8 x 8 pixels", .least = 0});
  v.field("declared_reason", r.declared_reason);
  v.field("losses", r.losses);
  v.field("picture", r.picture, {.says = "PNG; empty without"});
}

template <class V>
void describe(V& v, VerifyPair& r) {
  v.record("pair");
  v.field("first", r.first);
  v.field("second", r.second);
  v.field("verdict", r.verdict, {.words = verify_pair_verdicts});
  v.field("sentence", r.sentence);
  v.field("shift", r.shift, {.says = "relative difference of the second's mean from the first's"});
  describe_finite(v, "whole_shift", r.whole_shift);
  describe_finite(v, "would_see", r.would_see,
                  {.says = "the least relative error of the mean that shows with probability 0.99", .least = 0});
  describe_finite(v, "relmse", r.relmse, {.least = 0});
  describe_finite(v, "ssim", r.ssim);
}

template <class V>
void describe(V& v, VerifyFault& r) {
  v.record("fault");
  v.field("engine", r.engine);
  v.field("sentence", r.sentence, {.says = "the size, the place and the channel of the difference"});
  v.field("place", r.place);
  v.field("pass", r.pass, {.says = "empty: not found"});
  v.field("pass_words", r.pass_words);
  v.field("pass_sentence", r.pass_sentence);
  v.field("right_picture", r.right_picture);
  v.field("odd_picture", r.odd_picture);
  v.field("difference_picture", r.difference_picture);
}

template <class V>
void describe(V& v, VerifyProbe& r) {
  v.record("probe");
  v.field("engine", r.engine);
  v.field("kind", r.kind, {.words = verify_probe_kinds});
  v.field("what", r.what);
  v.field("verdict", r.verdict, {.words = verify_probe_verdicts});
  v.field("sentence", r.sentence);
  describe_finite(v, "gain", r.gain, {.says = "image = gain * closed form + offset"});
  describe_finite(v, "gain_error", r.gain_error, {.says = "standard error", .least = 0});
  describe_finite(v, "offset", r.offset, {.says = "relative to the closed form's mean"});
}

template <class V>
void describe(V& v, VerifyScene& r) {
  v.record("scene");
  v.field("name", r.name);
  v.field("path", r.path);
  v.field("purpose", r.purpose);
  v.field("width", r.width, {.least = 1});
  v.field("height", r.height, {.least = 1});
  v.field("exposure", r.exposure, {.says = "stops"});
  v.field("seconds", r.seconds, {.least = 0});
  v.field("verdict", r.verdict, {.words = verify_scene_verdicts});
  v.field("sentence", r.sentence);
  v.field("believed", r.believed, {.says = "who agrees"});
  v.field("pictures", r.pictures);
  v.field("pairs", r.pairs);
  v.field("faults", r.faults);
  v.field("notes", r.notes);
  v.maybe("title", r.title, {.says = "name of the scene on pages; absent: its own name"});
}

template <class V>
void describe(V& v, VerifyRecord& r) {
  v.record(
      "photonproof verify",
      "The engines that agree on each scene, the least error that each pair would have shown, and the engine that is "
      "wrong where they differ. An undefined number is absent. Times are in seconds, errors relative; paths are "
      "relative to this file.");
  v.version("schema_version", 1);
  v.field("created", r.created, {.says = "UTC, ISO 8601"});
  v.field("program", r.program);
  v.field("host", r.host);
  v.field("command", r.command, {.says = "how the run is repeated"});
  v.field("power", r.power, {.says = "the relative error of the mean that every pair was to show", .least = 0});
  v.field("seconds", r.seconds, {.least = 0});
  v.field("interrupted", r.interrupted);
  v.field("engines", r.engines);
  v.field("probes", r.probes);
  v.field("scenes", r.scenes);
}

}  // namespace photonproof::inline reports_verify
