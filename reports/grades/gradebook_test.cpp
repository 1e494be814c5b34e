#include "reports/grades/gradebook.h"

#include <gtest/gtest.h>

#include "reports/grades/test_grades.h"

namespace photonproof::inline reports_grades {
namespace {

TEST(Gradebook, a_row_a_submission_with_names_quoted_and_formulas_disarmed) {
  EXPECT_EQ(
      gradebook_csv(test_grades()),
      "submission,points,max_points,correctness_points,speed_points,speedup,speedup_low,speedup_high,timing,"
      "scene one,hidden secret,flags,sentence\r\n"
      "broken,0,100,0,0,,,,not measured,,,,\r\n"
      "'=partly,26.67,100,26.67,0,,,,not right,right,wrong,right-on-public-only,right on the public scenes only\r\n"
      "\"quick, \"\"the\"\" team\",60,100,40,20,4,3.9,4.1,measured,right,right,,right on all 2 scenes\r\n");
}

TEST(Gradebook, the_table_is_the_leaderboard) {
  EXPECT_EQ(grades_table(test_grades()),
            "submission            points  scenes  speed-up         first of all\n"
            "quick, \"the\" team     60/100  2 of 2  4x (3.9 to 4.1)  right on all 2 scenes\n"
            "=partly            26.67/100  1 of 2  not right        right on the public scenes only\n"
            "broken                 0/100  0 of 0  not measured     \n");
}

TEST(Gradebook, equal_points_are_ranked_by_speed_and_then_by_name) {
  Grades grades = test_grades();
  for (SubmissionGrade& submission : grades.submissions) {
    submission.correctness_points = 1;
    submission.speed.points = 0;
  }
  const auto order = leaderboard(grades);
  EXPECT_EQ(order[0]->folder, "submissions/quick");
  EXPECT_EQ(order[1]->name, "=partly");
  EXPECT_EQ(order[2]->name, "broken");
}

}  // namespace
}  // namespace photonproof::inline reports_grades
