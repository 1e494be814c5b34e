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

TEST(Gradebook, the_table_names_the_proof_of_a_caught_submission_and_puts_it_last) {
  Grades grades = test_grades();
  grades.submissions[2].flags = {{"copy-of-given", "the image that was handed out", "one", ""}};
  const std::string table = grades_table(grades);
  EXPECT_NE(table.find("caught, no place: the image that was handed out\n"), std::string::npos);
  EXPECT_GT(table.find("caught, no place"), table.find("broken"));
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

TEST(Gradebook, a_flag_that_shows_copying_costs_the_place_and_a_hint_does_not) {
  Grades grades = test_grades();
  SubmissionGrade& quick = grades.submissions[2];
  for (const char* hint :
       {"same-as-other", "seed-ignored", "right-on-public-only", "runs-differ", "fast-on-timed-only"}) {
    quick.flags = {{hint, "hint", "one", ""}};
    EXPECT_EQ(caught_at(quick), nullptr) << hint;
    EXPECT_EQ(leaderboard(grades).front(), &quick) << hint;
  }
  for (const char* proof :
       {"copy-of-given", "copy-of-reference", "keeps-results", "copies-found", "parameters-ignored"}) {
    quick.flags = {{"seed-ignored", "hint", "one", ""}, {proof, "proof", "one", ""}};
    ASSERT_NE(caught_at(quick), nullptr) << proof;
    EXPECT_EQ(caught_at(quick)->sentence, "proof");
    EXPECT_EQ(leaderboard(grades).back(), &quick) << proof;
  }
  // A program that renders one scene only is wrong on public scenes, too: a mistake. Right there, it is a stored image.
  quick.flags = {{"same-image", "proof", "secret", "one"}};
  EXPECT_EQ(caught_at(quick), nullptr);
  quick.flags.push_back({"right-on-public-only", "hint", "secret", ""});
  ASSERT_NE(caught_at(quick), nullptr);
  EXPECT_EQ(caught_at(quick)->sentence, "proof");
}

}  // namespace
}  // namespace photonproof::inline reports_grades
