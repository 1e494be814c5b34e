#include "reports/grades/grades_json.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "reports/grades/grade_fields.h"
#include "reports/grades/test_grades.h"
#include "scenes/files/test_folder.h"
#include "scenes/records/test_record.h"

namespace photonproof::inline reports_grades {
namespace {

TEST(GradesJson, reads_back_what_was_written) {
  const Grades grades = test_grades();
  const nlohmann::ordered_json json = grades_to_json(grades);
  EXPECT_EQ(grades_to_json(grades_from_json(json, "g")).dump(), json.dump());
  const Grades back = grades_from_json(json, "g");
  EXPECT_EQ(back.submissions[2].scenes[0].runs[0].image, "cells/a-1/image.exr");
  EXPECT_EQ(back.submissions[1].scenes[1].findings[0].height, 4);
  EXPECT_EQ(back.speed_tiers.size(), 2u);
  EXPECT_EQ(back.submissions[2].speed.speedup.interval->low, 3.9);
}

TEST(GradesJson, has_the_schema_that_is_printed) {
  expect_schema_in<Grades>("reports/grades/grades.schema.json");
  expect_reader_agrees_with_schema(test_grades());
}

TEST(GradesJson, a_document_of_another_version_is_refused) {
  nlohmann::ordered_json json = grades_to_json(test_grades());
  json["grades_version"] = 99;
  EXPECT_EQ(input_error_of([&] { grades_from_json(json, "g.json"); }),
            "g.json: error: has grades_version 99; this program reads 1");
}

TEST(GradesJson, images_outside_of_the_record_s_folder_are_refused) {
  for (const auto& damage : std::vector<void (*)(Grades&)>{
           [](Grades& grades) { grades.submissions[2].scenes[0].runs[0].image = "/srv/hidden.exr"; },
           [](Grades& grades) { grades.submissions[2].scenes[0].pictures["image"] = "../hidden.png"; },
           [](Grades& grades) { grades.scenes[0].reference_image = "cells/../../hidden.exr"; },
           [](Grades& grades) { grades.scenes[0].reference_picture = "/srv/hidden.png"; }}) {
    Grades grades = test_grades();
    damage(grades);
    EXPECT_NE(input_error_of([&] { grades_from_json(grades_to_json(grades), "g"); }).find("is outside of the folder"),
              std::string::npos);
  }
}

TEST(GradesJson, a_number_that_is_not_finite_is_never_written) {
  Grades grades = test_grades();
  grades.submissions[0].correctness_points = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(grades_to_json(grades), std::logic_error);
}

}  // namespace
}  // namespace photonproof::inline reports_grades
