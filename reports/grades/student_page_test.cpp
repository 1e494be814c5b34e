// Tests the contents of a student's page, and above all what it must not contain.

#include <regex>
#include <set>

#include "reports/grades/grade_pages.h"
#include "reports/grades/test_sample_grades.h"
#include "reports/view/test_sample_results.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_grades {
namespace {

class StudentPage : public testing::Test {
 protected:
  StudentPage() : grades(sample_grades(folder.path(), sample_images(24))) {}

  SubmissionGrade& submission(const std::string& name) {
    return *std::ranges::find(grades.submissions, name, &SubmissionGrade::name);
  }

  std::string html(const std::string& name) {
    write_student_page(grades, submission(name), folder.path(), folder.path() / "student.html");
    return file_text(folder.path() / "student.html");
  }

  const TemporaryFolder folder;
  Grades grades;
};

/// The file as the page embeds it.
std::string embedded(const std::filesystem::path& file) { return base64(file_text(file)); }

/// Files of the pictures that belong to a scene or to the submission's work on it.
std::vector<std::string> files_of(const GradedScene& scene, const SubmissionGrade& graded) {
  std::vector<std::string> files{scene.reference_picture};
  for (const auto& [role, file] : graded.scene(scene.name)->pictures) files.push_back(file);
  return files;
}

TEST_F(StudentPage, shows_pictures_of_public_scenes_and_of_no_hidden_one) {
  for (const SubmissionGrade& graded : grades.submissions) {
    const std::string page = html(graded.name);
    std::set<std::string> shown;
    for (const GradedScene& scene : grades.scenes) {
      if (scene.hidden || graded.scene(scene.name)->pictures.empty()) continue;
      for (const std::string& file : files_of(scene, graded)) {
        shown.insert(embedded(folder.path() / file));
        EXPECT_GE(count(page, embedded(folder.path() / file)), 1u) << graded.name << " " << file;
      }
    }
    for (const GradedScene& scene : grades.scenes)
      for (const std::string& file : files_of(scene, graded)) {
        EXPECT_EQ(count(page, file), 0u) << "a path: " << file;
        if (!scene.hidden) continue;
        // A copy of a public scene's image is that scene's, too.
        const std::string picture = embedded(folder.path() / file);
        EXPECT_TRUE(shown.contains(picture) || count(page, picture) == 0) << graded.name << " " << file;
      }
    EXPECT_EQ(count(page, "data:image/png"), count(page, "<img")) << graded.name;
  }
}

TEST_F(StudentPage, tells_nothing_of_a_hidden_scene_but_verdict_listed_mistakes_and_values) {
  SubmissionGrade& graded = submission("no-caustic");
  SceneGrade& grade = graded.scenes[4];
  ASSERT_EQ(grade.scene, "secret-lamps");
  grade.sentence = "LEAK the scene's sentence";
  grade.findings[0].sentence = "LEAK below the second lamp";
  grade.findings[0].x = 7171;
  grade.findings[0].y = 8282;
  grade.findings.push_back({"coarse", "LEAK", "near 31, 44 photons are lost", 1, 2, 3, 4, 0.1});
  grade.findings.push_back({"LEAK <b>", "LEAK", "a lamp of secret-lamps is skipped", 1, 2, 3, 4, 0.1});
  grade.checks[0].sentence = "LEAK worst at columns 40 to 47";
  grade.checks[0].parameters = "LEAK";
  grade.runs = {{9091, "crash", "LEAK signal", 77.25, 1, 1, "LEAK.exr", "LEAK", "LEAK sphere 1 2 3"}};
  graded.flags.push_back({"seed-ignored", "LEAK", "secret-lamps", ""});
  graded.sentence = "LEAK the first thing";
  graded.speed.sentence = "not timed: hidden scene secret-lamps is not right";
  graded.scenes[0].verdict = SceneVerdict::wrong;
  graded.scenes[0].sentence = "the same image as scene secret-lamps's, or hidden scene hidden-mirror's";
  graded.scenes[0].findings.clear();
  const std::string page = html("no-caustic");
  for (const char* secret :
       {"LEAK", "7171", "8282", "31, 44", "secret", "hidden-mirror", "more-spheres", "photons are lost",
        "left and right change places", "9091", "77.2", "424242", "photon-mapping.toml"})
    EXPECT_EQ(count(page, secret), 0u) << secret;
  EXPECT_GE(count(page, "hidden scene 2"), 2u);
  EXPECT_GE(count(page, "something that the scene holds is not rendered as it should be; the resolution is too low"),
            1u);
  EXPECT_GE(count(page, "rendered smaller and enlarged, or not every pixel is computed"), 1u);
  EXPECT_GE(count(page, "not timed: a hidden scene is not right"), 1u);
  EXPECT_GE(count(page, "the same image as a hidden scene&apos;s, or a hidden scene&apos;s"), 1u);
  EXPECT_GE(count(page, "flip 0.331, bound 0.120 (missed)"), 1u);
}

TEST_F(StudentPage, tells_nothing_of_other_submissions) {
  submission("twin-of-quick").flags.push_back({"same-as-other", "like upside", "1", "upside"});
  const std::string page = html("twin-of-quick");
  for (const char* other : {"upside", "same noise", "hard-coded", "honest"}) EXPECT_EQ(count(page, other), 0u) << other;
}

TEST_F(StudentPage, a_copied_image_on_a_hidden_scene_is_called_one) {
  EXPECT_GE(count(html("hard-coded"), "the same image as of scene 1"), 1u);
}

TEST_F(StudentPage, a_failed_hidden_scene_tells_how_its_run_ended) {
  EXPECT_GE(count(html("crashes"), "the program crashes"), 1u);
  EXPECT_GE(count(html("never-ends"), "the program is not done in time"), 1u);
}

TEST_F(StudentPage, points_of_the_rows_add_up_to_the_total) {
  for (const SubmissionGrade& graded : grades.submissions) {
    const std::string page = html(graded.name);
    const std::string body = page.substr(page.find("<table class=\"points-table\">"));
    const std::regex cells(
        "<td class=\"number\">(?:<b>)?([0-9.]+|none yet)(?:</b>)?</td><td class=\"number\">([0-9.]+)</td>");
    const std::string table = body.substr(0, body.find("</table>"));
    std::vector<std::pair<double, double>> rows;
    for (std::sregex_iterator it(table.begin(), table.end(), cells), end; it != end; ++it)
      rows.emplace_back((*it)[1] == "none yet" ? 0 : std::stod((*it)[1]), std::stod((*it)[2]));
    ASSERT_EQ(rows.size(), 7u);  // five scenes, performance, total
    double points = 0, most = 0;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      points += rows[i].first;
      most += rows[i].second;
    }
    EXPECT_DOUBLE_EQ(points, rows.back().first) << graded.name;
    EXPECT_DOUBLE_EQ(most, rows.back().second);
    EXPECT_DOUBLE_EQ(points, graded.points());
  }
}

std::string top_of(const std::string& page) { return page.substr(0, page.find("<main>")); }

TEST_F(StudentPage, speed_is_either_not_timed_with_the_reason_or_has_points_with_the_ratio) {
  const std::string untimed = html("no-caustic");
  EXPECT_EQ(count(untimed, "<b>0</b> of 60"), 0u);
  EXPECT_EQ(count(top_of(untimed), "<b class=\"words\">not timed</b> up to 60"), 1u);
  EXPECT_EQ(count(top_of(untimed), "<span class=\"remark\">scene 1 is not right</span>"), 1u);
  EXPECT_EQ(count(untimed, "<td>not timed</td><td class=\"number\">none yet</td>"), 1u);
  const std::string timed = top_of(html("honest"));
  EXPECT_EQ(count(timed, "<b>40</b> of 60"), 1u);
  EXPECT_EQ(count(timed, "6.30 times as fast as the baseline (6.11 to 6.49)</span>"), 1u);
  EXPECT_EQ(count(timed, "not timed"), 0u);
}

TEST_F(StudentPage, a_course_without_points_for_speed_has_no_speed_card) {
  grades.speed_points = 0;
  EXPECT_EQ(count(html("no-caustic"), "<span class=\"score-name\">"), 2u);
}

TEST_F(StudentPage, the_top_shows_the_first_mistake_with_its_place_and_the_next_step) {
  const std::string wrong = top_of(html("no-caustic"));
  EXPECT_EQ(count(wrong, "<figure class=\"shot submitted\">") + count(wrong, "<figure class=\"shot reference\">"), 2u);
  EXPECT_EQ(count(wrong, "class=\"mark\""), 2u);
  EXPECT_EQ(count(wrong, "scene 1: 9 × 9 pixels in the lower right (columns 12 to 20, rows 15 to 23)"), 1u);
  EXPECT_EQ(count(wrong,
                  "<b>Next</b> Mend scene 1, as told below. Speed is timed once the images "
                  "are right.</p>"),
            1u);
  EXPECT_EQ(count(top_of(html("does-not-build")), "<b>Next</b> Make it build"), 1u);
  EXPECT_EQ(count(top_of(html("quick")), "<b>Next</b> The tier of 20× is reached. There is none beyond."), 1u);
  EXPECT_EQ(count(top_of(html("honest")), "The next, 20× for 60 points, needs"), 1u);
  // A submission that is wrong on hidden scenes alone shows no picture on top.
  EXPECT_EQ(count(top_of(html("hard-coded")), "<img"), 0u);
}

TEST_F(StudentPage, the_same_mistake_on_several_scenes_is_told_once_on_top) {
  const std::string page = html("upside");
  const std::string top = page.substr(0, page.find("<main>"));
  EXPECT_EQ(count(top, "the image is upside down"), 1u);
  EXPECT_EQ(count(top, "href=\"#scene-1\""), 1u);
  EXPECT_EQ(count(top, "href=\"#scene-3\""), 1u);
  EXPECT_EQ(count(top, "hidden scene 2"), 1u);
}

TEST_F(StudentPage, marks_lie_where_the_findings_are) {
  // 24 pixels a side: the corner begins at column 12 and row 15, and is 9 wide and high.
  const std::string page = html("no-caustic");
  EXPECT_EQ(count(page, "left:50.000%;top:62.500%;width:37.500%;height:37.500%"),
            11u);                                          // 3 scenes of 3 pictures, 2 on top
  EXPECT_EQ(count(html("upside"), "class=\"mark\""), 0u);  // whole image: no mark
}

TEST_F(StudentPage, escapes_every_text_and_keeps_logs_in_lines) {
  const std::string evil = "<script>alert(1)</script>\"'&{{name}}\x1b[31m\xff\u202Egnp.exe";
  SubmissionGrade& graded = submission("no-caustic");
  graded.name = graded.build_sentence = graded.speed.sentence = evil;
  graded.build_log = "line 1\n" + evil + "\n" + std::string(100'000, 'x') + "\n";
  for (SceneGrade& grade : graded.scenes) {
    grade.sentence = evil;
    for (GradedFinding& finding : grade.findings) finding.sentence = finding.cause = finding.kind = evil;
    for (GradedRun& run : grade.runs) run.end = run.sentence = run.log_tail = evil;
    for (GradedCheck& check : grade.checks) check.metric = check.sentence = evil;
  }
  grades.title = grades.created = grades.containment = grades.speed_rule = grades.host.cpu = evil;
  for (GradedScene& scene : grades.scenes)
    if (!scene.hidden) scene.says = scene.reference = evil;
  const std::string page = html(evil);
  EXPECT_EQ(count(page, "<script>"), 1u);
  EXPECT_EQ(count(page, "alert(1)</script>"), 0u);
  EXPECT_EQ(count(page, "\u202E"), 0u);
  EXPECT_EQ(count(page, "\x1b"), 0u);
  EXPECT_EQ(count(page, "\xff"), 0u);
  EXPECT_GE(count(page, "{{name}}"), 5u);
  EXPECT_EQ(count(page, std::string(3000, 'x')), 0u);
  EXPECT_EQ(count(page, "line 1\n&lt;script&gt;"), 1u);
}

TEST_F(StudentPage, refers_to_nothing_outside_itself) {
  const std::string page = html("tiles");
  for (const char* away : {"http:", "https:", "url(", "@import", "fetch(", "file:"})
    EXPECT_EQ(count(page, away), 0u) << away;
  EXPECT_EQ(count(page, "src="), count(page, "src=\"data:image/png;base64,"));
  EXPECT_EQ(count(page, "href="), count(page, "href=\"#") + count(page, "href=\"data:,\""));
}

TEST_F(StudentPage, a_program_that_does_not_build_has_its_log_open) {
  const std::string page = html("does-not-build");
  EXPECT_EQ(count(page, "<details open>"), 1u);
  EXPECT_EQ(count(page, "&apos;Scene&apos; was not declared"), 1u);
  EXPECT_EQ(count(page, "Does not build: make ended with 2"), 1u);
}

TEST_F(StudentPage, a_missing_picture_is_said) {
  std::filesystem::remove(folder.path() / "references/2.png");
  EXPECT_EQ(count(html("honest"), "references/2.png is missing"), 1u);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades
