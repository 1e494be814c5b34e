#include "reports/grades/grade_words.h"

#include "reports/grades/test_sample_grades.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_grades {
namespace {

TEST(GradeWords, points_have_no_needless_digits) {
  EXPECT_EQ(points_text(40), "40");
  EXPECT_EQ(points_text(0), "0");
  EXPECT_EQ(points_text(100), "100");
  EXPECT_EQ(points_text(6.5), "6.5");
  EXPECT_EQ(points_text(20.0 / 3), "6.67");
}

TEST(GradeWords, a_place_is_told_by_where_it_is_and_by_its_pixels) {
  GradedScene scene;
  scene.width = scene.height = 90;
  EXPECT_EQ(place_text({"", "", "", 0, 0, 90, 90, 1}, scene), "whole image");
  EXPECT_EQ(place_text({"", "", "", 3, 80, 12, 8, 1}, scene),
            "12 × 8 pixels in the lower left (columns 3 to 14, rows 80 to 87)");
  EXPECT_EQ(place_text({"", "", "", 70, 40, 1, 8, 1}, scene), "1 × 8 pixels at the right (column 70, rows 40 to 47)");
  EXPECT_EQ(place_text({"", "", "", 40, 40, 8, 8, 1}, scene),
            "8 × 8 pixels in the middle (columns 40 to 47, rows 40 to 47)");
  EXPECT_EQ(place_text({}, scene), "");
}

Grades tiers() {
  Grades grades;
  grades.speed_tiers = {{2, 20}, {5, 40}, {20, 60}};
  return grades;
}

SpeedGrade speed_of(double ratio, double points) {
  SpeedGrade speed;
  speed.state = SpeedGrade::State::measured;
  speed.scenes.resize(1);
  speed.speedup.value = ratio;
  speed.points = points;
  return speed;
}

TEST(GradeWords, a_tier_says_what_the_next_one_needs) {
  EXPECT_EQ(tier_words(tiers(), speed_of(1.6, 0)),
            "No tier is reached yet. The next, 2× for 20 points, needs 1.25 times this speed.");
  EXPECT_EQ(tier_words(tiers(), speed_of(8, 40)),
            "The tier of 5× is reached. The next, 20× for 60 points, needs 2.50 times this speed.");
  EXPECT_EQ(tier_words(tiers(), speed_of(25, 60)), "The tier of 20× is reached. There is none beyond.");
  SpeedGrade wrong;
  wrong.state = SpeedGrade::State::not_right;
  EXPECT_EQ(tier_words(tiers(), wrong), "Speed counts once the scenes it asks for are right.");
  EXPECT_EQ(tier_words(tiers(), {}), "");
}

TEST(GradeWords, a_curve_says_where_it_ends) {
  Grades grades;
  grades.speed_curve = SpeedTier{20, 60};
  EXPECT_EQ(tier_words(grades, speed_of(8, 41)), "All 60 points are given at 20×.");
  EXPECT_EQ(tier_words(grades, speed_of(25, 60)), "");
}

TEST(GradeWords, hidden_scenes_are_numbered_apart) {
  Grades grades;
  for (const char* name : {"1", "secret", "2", "dark"}) grades.scenes.push_back(named_scene(name));
  grades.scenes[1].hidden = grades.scenes[3].hidden = true;
  EXPECT_EQ(student_title(grades, grades.scenes[0]), "scene 1");
  EXPECT_EQ(student_title(grades, grades.scenes[1]), "hidden scene 1");
  EXPECT_EQ(student_title(grades, grades.scenes[2]), "scene 2");
  EXPECT_EQ(student_title(grades, grades.scenes[3]), "hidden scene 2");
  EXPECT_EQ(staff_title(grades.scenes[3]), "hidden scene dark");
}

TEST(GradeWords, a_log_keeps_its_lines_and_loses_what_a_page_must_not_have) {
  EXPECT_EQ(log_text("a\x1b[1mb\tc\nd\u202Ee"), "a [1mb c\nd\uFFFDe\n");
  EXPECT_EQ(log_text(""), "");
  std::string many;
  for (int i = 0; i < 203; ++i) many += "line " + std::to_string(i) + "\n";
  const std::string tail = log_text(many);
  EXPECT_TRUE(tail.starts_with("… 3 lines before\nline 3\n"));
  EXPECT_EQ(count(tail, "\n"), 201u);
  EXPECT_LT(log_text(std::string(1 << 20, 'x')).size(), 2100u);
}

TEST(GradeWords, how_many_are_right) {
  Grades grades;
  for (const char* name : {"1", "2", "h"}) grades.scenes.push_back(named_scene(name));
  grades.scenes[2].hidden = true;
  SubmissionGrade submission;
  EXPECT_EQ(correctness_words(grades, submission), "no scene was graded");
  submission.scenes.resize(3);
  for (std::size_t i = 0; i < 3; ++i) submission.scenes[i].scene = grades.scenes[i].name;
  submission.scenes[0].verdict = SceneVerdict::borderline;
  submission.scenes[1].verdict = SceneVerdict::failed;
  submission.scenes[2].verdict = SceneVerdict::wrong;
  EXPECT_EQ(correctness_words(grades, submission), "right on 1 of 2 public scenes and 0 of 1 hidden ones");
  submission.scenes[2].verdict = SceneVerdict::skipped;
  EXPECT_EQ(correctness_words(grades, submission), "right on 1 of 2 public scenes");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades
