// Tests that students read the same sentence for a kind of mistake on every hidden scene.

#include "reports/grades/hidden_words.h"

#include <gtest/gtest.h>

#include "reports/grades/test_sample_grades.h"

namespace photonproof::reports::inline reports_grades {
namespace {

class HiddenScene : public testing::Test {
 protected:
  HiddenScene() {
    for (const char* name : {"1", "secret", "3", "3-b"}) grades.scenes.push_back(named_scene(name));
    for (const std::size_t hidden : {1, 2, 3}) grades.scenes[hidden].hidden = true;
    grade.scene = "secret";
    grade.verdict = SceneVerdict::wrong;
  }
  HiddenWords words() const { return hidden_words(grades, submission, grade); }
  HiddenWords shown_words(const std::string& kind) {
    grade.findings = {{kind, "the cube is missing at (3, 4)", "the cube is never added", 3, 4, 5, 6, 1}};
    return words();
  }

  Grades grades;
  SubmissionGrade submission;
  SceneGrade grade;
};

const char* const of_content = "something that the scene holds is not rendered as it should be";

TEST_F(HiddenScene, a_mistake_that_any_scene_would_show_is_told) {
  EXPECT_EQ(shown_words("upside-down").sentence, "the image is upside down");
  EXPECT_EQ(shown_words("upside-down").causes,
            std::vector<std::string>{"rows are written from the bottom up, or y is not turned from world to image"});
  EXPECT_EQ(shown_words("gamma-twice").sentence, "gamma applied twice");
  EXPECT_EQ(shown_words("indirect-energy").sentence, "indirect light too bright or too dark");
  EXPECT_EQ(shown_words("other-scene").sentence, "the same image as of another scene");
}

TEST_F(HiddenScene, what_the_scene_holds_is_not_given_away) {
  for (const char* kind : {"object-missing", "caustic-missing", "caustic-twice", "mirror-diffuse", "glass-opaque",
                           "water-flat", "water-missing", "lamp-missing", "walls-swapped", "hard-shadows",
                           "shadows-missing", "a-kind-of-tomorrow", ""}) {
    EXPECT_EQ(shown_words(kind).sentence, of_content) << kind;
    EXPECT_EQ(shown_words(kind).causes,
              std::vector<std::string>{"try objects, materials and lamps of every kind, in scenes of your own"})
        << kind;
  }
}

TEST_F(HiddenScene, several_mistakes_are_told_once_each) {
  grade.findings = {{"glass-opaque", "", "", 0, 0, 0, 0, 1},
                    {"coarse", "", "", 0, 0, 0, 0, 1},
                    {"object-missing", "", "", 0, 0, 0, 0, 1},
                    {"differs", "differs here, not explained: on the cube", "", 0, 0, 0, 0, 1}};
  EXPECT_EQ(words().sentence, std::string(of_content) + "; the resolution is too low");
  EXPECT_EQ(words().causes.size(), 2u);
}

TEST_F(HiddenScene, without_a_finding_it_differs) {
  EXPECT_EQ(words().sentence, "differs from the reference by more than noise explains");
  EXPECT_EQ(shown_words("differs").sentence, "differs from the reference by more than noise explains");
  EXPECT_TRUE(words().causes.empty());
}

TEST_F(HiddenScene, a_copy_is_told_and_no_hidden_scene_is_named) {
  grade.findings = {{"coarse", "", "", 0, 0, 0, 0, 1}};
  submission.flags = {{"seed-ignored", "", "secret", ""}, {"same-image", "", "secret", "3"}};
  EXPECT_EQ(words().sentence, "the same image as of another scene");
  EXPECT_TRUE(words().causes.empty());
  submission.flags = {{"same-image", "", "secret", "1"}};
  EXPECT_EQ(words().sentence, "the same image as of scene 1");
  submission.flags = {{"copy-of-reference", "", "secret", ""}};
  EXPECT_EQ(words().sentence, "a copy of the reference: it has the reference's own noise");
  submission.flags = {{"copy-of-reference", "", "3", ""}};
  EXPECT_EQ(words().sentence, "the resolution is too low");
}

TEST_F(HiddenScene, its_verdict_has_words_of_its_own) {
  grade.findings = {{"object-missing", "", "", 0, 0, 0, 0, 1}};
  const auto said = [&](SceneVerdict verdict) {
    grade.verdict = verdict;
    EXPECT_TRUE(words().causes.empty());
    return words().sentence;
  };
  EXPECT_EQ(said(SceneVerdict::right), "");
  EXPECT_EQ(said(SceneVerdict::borderline), "noise leaves it open, which counts as right");
  EXPECT_EQ(said(SceneVerdict::unused), "nobody is graded on it");
  EXPECT_EQ(said(SceneVerdict::skipped), "not graded in this run");
  EXPECT_EQ(said(SceneVerdict::failed), "no image came of it");
  grade.runs = {
      {.end = "timeout", .sentence = "the sphere took too long", .image = {}, .checksum = {}, .log_tail = {}}};
  EXPECT_EQ(said(SceneVerdict::failed), "the program is not done in time");
}

TEST_F(HiddenScene, names_of_hidden_scenes_leave_a_text_and_nothing_else_does) {
  const auto told = [&](const char* text) { return without_hidden_names(grades, text); };
  EXPECT_EQ(told("same image as hidden scene secret's"), "same image as a hidden scene's");
  EXPECT_EQ(told("same image as scene 3's, scene 3-b's and scene 1's"),
            "same image as a hidden scene's, a hidden scene's and scene 1's");
  EXPECT_EQ(told("not timed: hidden scene '3' is not right"), "not timed: a hidden scene is not right");
  EXPECT_EQ(told("scene 31 has 3 lamps"), "scene 31 has 3 lamps");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades
