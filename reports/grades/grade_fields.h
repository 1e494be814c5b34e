// The members of grades.json (reports/grades/grade_record.h), as scenes/records/record_note.h describes records.
#pragma once

#include "reports/grades/grade_record.h"
#include "reports/record/results_fields.h"

namespace photonproof::inline reports_grades {

inline constexpr std::array scene_verdict_words{"right", "borderline", "wrong", "failed", "unused", "skipped"};
inline constexpr std::array check_side_words{"inside", "outside", "undecided"};
inline constexpr std::array speed_state_words{"not measured", "not right", "measured", "too noisy",
                                              "other images when timed"};
inline std::span<const char* const> names_of(SceneVerdict) { return scene_verdict_words; }
inline std::span<const char* const> names_of(GradedCheck::Side) { return check_side_words; }
inline std::span<const char* const> names_of(SpeedGrade::State) { return speed_state_words; }

template <class V>
void describe(V& v, GradedRun& r) {
  v.record("run");
  v.field("seed", r.seed);
  v.field("end", r.end, {.says = "ok, crash, timeout, memory ..."});
  v.field("sentence", r.sentence);
  v.field("wall_seconds", r.wall_seconds);
  v.field("cpu_seconds", r.cpu_seconds);
  v.field("peak_bytes", r.peak_bytes);
  v.field("image", r.image, {.file = true});
  v.field("checksum", r.checksum, {.says = "checksum of the image's values"});
  v.field("log", r.log_tail);
}

template <class V>
void describe(V& v, GradedCheck& r) {
  v.record("check", "one bound on one metric");
  v.field("metric", r.metric);
  v.field("value", r.value, {.says = "mean over the runs; its interval decides"});
  v.field("bound", r.bound);
  v.field("parameters", r.parameters);
  v.field("side", r.side);
  v.field("sentence", r.sentence);
}

template <class V>
void describe(V& v, GradedFinding& r) {
  v.record("finding", "a mistake of the image");
  v.field("kind", r.kind);
  v.field("sentence", r.sentence);
  v.field("cause", r.cause);
  auto where = std::tie(r.x, r.y, r.width, r.height);
  v.field("where", where, {.says = "x, y, width, height in pixels"});
  v.field("explained", r.explained, {.says = "share of the squared error"});
}

template <class V>
void describe(V& v, SceneGrade& r) {
  v.record("scene_grade");
  v.field("scene", r.scene);
  v.field("verdict", r.verdict);
  v.field("sentence", r.sentence);
  v.field("points", r.points);
  v.field("checks", r.checks);
  v.field("findings", r.findings);
  v.field("runs", r.runs);
  v.field("pictures", r.pictures, {.file = true});
  v.maybe("partial", r.partial, {.says = "share of the points that a wrong image keeps"});
}

template <class V>
void describe(V& v, SceneSpeed& r) {
  v.record("scene_speed");
  v.field("scene", r.scene);
  v.field("ratio", r.ratio, {.says = "baseline's time over its own"});
  v.field("baseline_seconds", r.baseline_seconds, {.says = "a round each"});
  v.field("seconds", r.seconds);
  v.field("busy_cores_of_others", r.busy);
}

template <class V>
void describe(V& v, SpeedGrade& r) {
  v.record("speed");
  v.field("state", r.state);
  v.field("sentence", r.sentence);
  v.field("points", r.points);
  v.field("rounds", r.rounds);
  v.when(!r.scenes.empty() || r.state == SpeedGrade::State::measured, "speedup", r.speedup,
         {.says = "geometric mean of the scenes' ratios; the interval has 99 %"});
  v.maybe("scenes", r.scenes);
}

template <class V>
void describe(V& v, GradeFlag& r) {
  v.record("flag", "something staff should look at");
  v.field("kind", r.kind);
  v.field("sentence", r.sentence);
  v.field("scene", r.scene);
  v.field("other", r.other, {.says = "the other submission or scene"});
}

template <class V>
void describe(V& v, SubmissionGrade& r) {
  v.record("submission");
  v.field("name", r.name);
  v.field("folder", r.folder);
  v.field("source", r.source);
  v.field("checksum", r.checksum);
  v.derived("points", r.points());
  v.field("correctness_points", r.correctness_points);
  v.field("sentence", r.sentence);
  v.object("build", [&r](auto& build) {
    build.field("ok", r.built);
    build.field("sentence", r.build_sentence);
    build.field("log", r.build_log);
    build.field("seconds", r.build_seconds);
  });
  v.field("scenes", r.scenes);
  v.field("speed", r.speed);
  v.field("flags", r.flags);
}

template <class V>
void describe(V& v, GradedScene& r) {
  v.record("scene");
  v.field("name", r.name);
  v.field("hidden", r.hidden);
  v.field("timed", r.timed);
  v.field("max_points", r.max_points);
  v.field("width", r.width);
  v.field("height", r.height);
  v.field("of", r.of, {.says = "the scene that a variant is made from"});
  v.field("variant", r.variant, {.says = "its kind"});
  v.field("says", r.says, {.says = "the change of the variant"});
  v.field("reference", r.reference, {.says = "where it comes from"});
  v.field("image", r.reference_image, {.file = true});
  v.field("picture", r.reference_picture, {.file = true});
  v.field("unused", r.unused, {.says = "why nobody is graded on it; empty: it counts"});
}

template <class V>
void describe(V& v, SpeedTier& r) {
  v.record("tier");
  v.field("ratio", r.ratio);
  v.field("points", r.points);
}

template <class V>
void describe(V& v, Grades& r) {
  v.record("photonproof grades",
           "The findings about a class. Times are in seconds, sizes in bytes; paths are relative to this file.");
  v.version("grades_version", grades_version);
  v.field("assignment", r.assignment);
  v.field("title", r.title);
  v.field("created", r.created, {.says = "UTC, ISO 8601"});
  v.field("command", r.command);
  v.field("host", r.host);
  v.field("versions", r.versions);
  v.field("seed", r.seed);
  v.field("contained", r.contained, {.says = "in the sandbox"});
  v.field("containment", r.containment, {.says = "how, or why not"});
  v.field("correctness_points", r.correctness_points);
  v.field("speed_points", r.speed_points);
  v.field("speed_rule", r.speed_rule);
  v.field("speed_tiers", r.speed_tiers);
  v.field("speed_curve", r.speed_curve);
  v.field("interrupted", r.interrupted);
  v.field("caveats", r.caveats);
  v.field("scenes", r.scenes);
  v.field("submissions", r.submissions);
}

}  // namespace photonproof::inline reports_grades
