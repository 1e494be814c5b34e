// The answers on top of the staff's page.

#include "reports/grades/staff_answers.h"

#include <gtest/gtest.h>

#include "reports/grades/test_grades.h"
#include "reports/grades/test_sample_grades.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_grades {
namespace {

using Lines = std::vector<std::string>;

Lines answer(const Grades& grades, const std::string& question) {
  for (const StaffAnswer& one : staff_answers(grades))
    if (one.question == question) return one.parts;
  return {};
}

TEST(StaffAnswers, of_a_class_name_the_fastest_the_passed_the_caught_and_the_wrong) {
  const TemporaryFolder folder;
  const Grades grades = sample_grades(folder.path(), sample_images(24));
  EXPECT_EQ(answer(grades, "Fastest and right"), Lines{"quick: 24.8 times as fast as the baseline (24.1 to 25.5)"});
  // quick, its twin, honest and slightly-better.
  EXPECT_EQ(answer(grades, "Passed"), Lines{"4 of 16 right on every scene (5 scenes, 2 of them hidden)"});
  EXPECT_EQ(answer(grades, "Caught"), (Lines{"hard-coded: hidden scene hidden-mirror: same image as scene 1's",
                                             "scene-switch: hidden scene hidden-mirror: same image as scene 1's",
                                             "given: scene 1: the image that was handed out, bit for bit"}));
  EXPECT_EQ(answer(grades, "To decide"), Lines{"twin-of-quick: the same noise as quick's images, on 5 scenes"});
  EXPECT_EQ(answer(grades, "Wrong image"), (Lines{"fewer-pixels: on scenes 2, secret-lamps",
                                                  "dim, gamma, no-caustic, tiles, upside: on all 5 scenes"}));
  EXPECT_EQ(answer(grades, "No image"),
            Lines{"crashes (crash), does-not-build (does not build), never-ends (timeout)"});
  EXPECT_EQ(answer(grades, "Clock"), Lines{"wall-clock time with all cores, in turns with the baseline"});
}

TEST(StaffAnswers, a_caught_submission_is_neither_the_fastest_nor_passed) {
  Grades grades = test_grades();
  EXPECT_EQ(answer(grades, "Fastest and right").front().substr(0, 18), "quick, \"the\" team:");
  EXPECT_EQ(answer(grades, "Passed"), Lines{"1 of 3 right on every scene (2 scenes, 1 of them hidden)"});
  grades.submissions[2].flags.push_back({"keeps-results", "kept", "one", ""});
  EXPECT_EQ(answer(grades, "Fastest and right"), Lines{"nobody: no submission is right on every scene"});
  EXPECT_EQ(answer(grades, "Passed"), Lines{"0 of 3 right on every scene (2 scenes, 1 of them hidden)"});
  EXPECT_EQ(answer(grades, "Wrong image"), Lines{"=partly: on scene secret"});
}

TEST(StaffAnswers, say_that_nobody_was_timed_or_that_speed_gives_no_points) {
  Grades grades = test_grades();
  grades.submissions[2].speed = {};
  EXPECT_EQ(answer(grades, "Fastest and right"), Lines{"not known: no right submission was timed"});
  grades.speed_points = 0;
  EXPECT_EQ(answer(grades, "Fastest and right"), Lines{"not asked: speed gives no points"});
  EXPECT_TRUE(answer(grades, "Clock").empty());
}

TEST(StaffAnswers, a_long_list_is_cut_and_counted) {
  Grades grades = test_grades();
  for (int i = 0; i < 20; ++i) {
    grades.submissions.push_back(grades.submissions[2]);
    grades.submissions.back().name = "copy " + std::to_string(i);
    grades.submissions.back().flags = {{"copy-of-given", "given", "one", ""}};
  }
  const Lines caught = answer(grades, "Caught");
  ASSERT_EQ(caught.size(), 6u);
  EXPECT_EQ(caught.back(), "and 15 more submissions");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades
