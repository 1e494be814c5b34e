#include "reports/grades/gradescope.h"

#include <nlohmann/json.hpp>

#include "reports/grades/test_grades.h"
#include "scenes/files/test_folder.h"
#include "scenes/records/test_schema_check.h"

namespace photonproof::inline reports_grades {
namespace {

using Json = nlohmann::ordered_json;

std::string gradescope_problem(const Json& document) {
  return schema_problem(read_file(PHOTONPROOF_SOURCE_DIR "/reports/grades/gradescope.schema.json"), document.dump());
}

TEST(Gradescope, results_of_every_submission_are_as_documented) {
  const Grades grades = test_grades();
  for (const SubmissionGrade& submission : grades.submissions)
    EXPECT_EQ(gradescope_problem(gradescope_results(grades, submission)), "");
}

TEST(Gradescope, the_documented_example_is_valid) {
  const Json example = Json::parse(R"({"score": 44.0, "execution_time": 136, "output": "Text", "visibility":
    "after_due_date", "stdout_visibility": "visible", "extra_data": {}, "tests": [{"score": 2.0, "max_score": 2.0,
    "status": "passed", "name": "Your name here", "name_format": "text", "number": "1.1", "output": "Giant multiline",
    "output_format": "text", "tags": ["tag1"], "visibility": "visible", "extra_data": {}}], "leaderboard":
    [{"name": "Accuracy", "value": 0.926}, {"name": "Time", "value": 15.1, "order": "asc"},
    {"name": "Stars", "value": "*****"}]})");
  EXPECT_EQ(gradescope_problem(example), "");
}

TEST(Gradescope, what_is_not_documented_is_refused_with_its_place) {
  const auto refused = [](const char* text) {
    const std::string problem = gradescope_problem(Json::parse(text));
    return problem.substr(0, problem.find(':'));
  };
  EXPECT_EQ(refused(R"({"score": 1, "tests": [{"visibility": "secret"}]})"), "#/tests/0/visibility");
  EXPECT_EQ(refused(R"({"score": 1, "leaderboard": [{"name": "a"}]})"), "#/leaderboard/0");
  EXPECT_EQ(refused(R"({"score": 1, "grade": 2})"), "#");
  EXPECT_EQ(refused(R"({"tests": [{"name": "no score anywhere"}]})").substr(0, 1), "#");
  EXPECT_EQ(refused(R"({"tests": [{"score": 1}]})"), "");
}

TEST(Gradescope, hidden_scenes_tell_what_the_students_page_tells) {
  const Grades grades = test_grades();
  const Json results = gradescope_results(grades, grades.submissions[1]);
  EXPECT_EQ(results["tests"].size(), 3u);
  EXPECT_EQ(
      results["tests"][1].dump(),
      R"({"score":0.0,"max_score":13.333,"status":"failed","name":"hidden scene 1","output":)"
      R"("wrong: something that the scene holds is not rendered as it should be\n- try objects, materials and lamps of )"
      R"(every kind, in scenes of your own","output_format":"text","visibility":"visible"})");
  for (const char* word : {"secret", "sphere", "caustic", "photons", "flip", "public"})
    EXPECT_EQ(results.dump().find(word), std::string::npos) << word;
}

TEST(Gradescope, sentences_about_public_scenes_and_speed_name_no_hidden_scene) {
  Grades grades = test_grades();
  SubmissionGrade& submission = grades.submissions[2];
  submission.scenes[0].verdict = SceneVerdict::wrong;
  submission.scenes[0].sentence = "same image as hidden scene secret's";
  submission.scenes[0].findings.push_back({"other-scene", "same image as scene secret's", "", 0, 0, 1, 1, 1});
  submission.speed.sentence = "not timed: hidden scene secret is not right";
  const Json results = gradescope_results(grades, submission);
  EXPECT_EQ(results.dump().find("secret"), std::string::npos) << results.dump();
  EXPECT_EQ(results["tests"][0]["output"].get<std::string>(),
            "wrong: same image as a hidden scene's\n- same image as a hidden scene's");
  EXPECT_EQ(results["tests"][2]["output"].get<std::string>(), "not timed: a hidden scene is not right");
}

TEST(Gradescope, the_leaderboard_has_a_speed_up_where_there_is_one) {
  const Grades grades = test_grades();
  EXPECT_EQ(gradescope_results(grades, grades.submissions[2])["leaderboard"].dump(),
            R"([{"name":"points","value":60.0},{"name":"speed-up","value":4.0}])");
  EXPECT_EQ(gradescope_results(grades, grades.submissions[0])["leaderboard"].size(), 1u);
}

}  // namespace
}  // namespace photonproof::inline reports_grades
