// A class of three for tests: one right and quick, one wrong on a hidden scene, one that does not build. Test code
// only.
#pragma once

#include <cstdint>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

inline Grades grades_without_submissions() {
  Grades grades;
  grades.assignment = "fake";
  grades.title = "Fake course";
  grades.host = {"Some CPU", "Debian 12", "6.1", 2, std::uint64_t{8} << 30};
  grades.correctness_points = 40;
  grades.speed_points = 60;
  grades.speed_rule = "20 points from 2x, 60 from 20x";
  grades.speed_tiers = {{2, 20}, {20, 60}};
  grades.scenes.resize(2);
  grades.scenes[0].name = "one";
  grades.scenes[0].max_points = 80 / 3.0;
  grades.scenes[1].name = "secret";
  grades.scenes[1].hidden = true;
  grades.scenes[1].max_points = 40 / 3.0;
  return grades;
}

inline Grades test_grades() {
  Grades grades = grades_without_submissions();
  SceneGrade right, wrong;
  right.scene = "one";
  right.verdict = SceneVerdict::right;
  right.points = 80 / 3.0;
  right.runs.push_back({.seed = 1,
                        .end = "ok",
                        .sentence = {},
                        .wall_seconds = 2,
                        .cpu_seconds = 3,
                        .peak_bytes = 4,
                        .image = "cells/a-1/image.exr",
                        .checksum = "0123",
                        .log_tail = {}});
  right.checks.push_back({"flip", {0.05, Interval{0.04, 0.06}}, 0.1, "exposure=0", GradedCheck::Side::inside, "fine"});
  wrong.scene = "secret";
  wrong.verdict = SceneVerdict::wrong;
  wrong.sentence = "flip is 0.3, at most 0.1 is right";
  wrong.findings.push_back(
      {"caustic-missing", "caustic missing below the glass sphere", "no photons", 1, 2, 3, 4, 0.5});
  SubmissionGrade quick;
  quick.name = "quick, \"the\" team";
  quick.folder = "submissions/quick";
  quick.built = true;
  quick.build_seconds = 1;
  quick.scenes = {right, right};
  quick.scenes[1].scene = "secret";
  quick.scenes[1].points = 40 / 3.0;
  quick.correctness_points = 40;
  quick.speed.state = SpeedGrade::State::measured;
  quick.speed.speedup = {4, Interval{3.9, 4.1}};
  quick.speed.scenes.push_back({"one", {4, Interval{3.9, 4.1}}, {4, 4}, {1, 1}, {0, 0}});
  quick.speed.points = 20;
  quick.sentence = "right on all 2 scenes";
  SubmissionGrade partly;
  partly.name = "=partly";
  partly.folder = "submissions/partly";
  partly.built = true;
  partly.scenes = {right, wrong};
  partly.correctness_points = 80 / 3.0;
  partly.speed.state = SpeedGrade::State::not_right;
  partly.flags.push_back({"right-on-public-only", "right on the public scenes only", "secret", ""});
  partly.sentence = "right on the public scenes only";
  SubmissionGrade broken;
  broken.name = "broken";
  broken.folder = "submissions/broken";
  broken.build_sentence = "the build exited with 2";
  grades.submissions = {broken, partly, quick};
  return grades;
}

}  // namespace photonproof::inline reports_grades
