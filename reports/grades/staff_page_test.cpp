// The page about a class for its staff.

#include "reports/grades/grade_pages.h"
#include "reports/grades/likeness_groups.h"
#include "reports/grades/test_sample_grades.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_grades {
namespace {

class StaffPage : public testing::Test {
 protected:
  StaffPage() : grades(sample_grades(folder.path(), sample_images(24))) {}

  std::string html(const std::string& name = "staff.html") {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    write_staff_page(grades, folder.path(), folder.path() / name);
    return file_text(folder.path() / name);
  }

  const TemporaryFolder folder;
  Grades grades;
};

TEST_F(StaffPage, has_a_row_and_a_section_a_submission_and_a_cell_a_scene) {
  const std::string page = html();
  EXPECT_EQ(count(page, "<details class=\"submission\""), grades.submissions.size());
  EXPECT_EQ(count(page, "<a class=\"cell\""), grades.submissions.size() * grades.scenes.size());
  EXPECT_EQ(count(page, "<article class=\"graded\""), grades.submissions.size() * grades.scenes.size());
  // Every cell links to its scene.
  for (std::size_t place = 1; place <= grades.submissions.size(); ++place)
    for (std::size_t scene = 1; scene <= grades.scenes.size(); ++scene) {
      const std::string id = "s" + std::to_string(place) + "-" + std::to_string(scene);
      EXPECT_EQ(count(page, "href=\"#" + id + "\""), 1u) << id;
      EXPECT_EQ(count(page, "id=\"" + id + "\""), 1u) << id;
    }
}

TEST_F(StaffPage, the_best_come_first) {
  const std::string page = html();
  EXPECT_LT(page.find(">quick</a>"), page.find(">honest</a>"));
  EXPECT_LT(page.find(">honest</a>"), page.find(">upside</a>"));
}

TEST_F(StaffPage, a_caught_submission_has_no_place_and_stands_last_with_the_reason) {
  const std::string page = html();
  const std::size_t board = page.find("id=\"leaderboard\""), end = page.find("id=\"matrix\"");
  const std::string rows = page.substr(board, end - board);
  EXPECT_EQ(count(rows, "<tr class=\"caught\">"), 3u);
  EXPECT_EQ(count(rows, "<b class=\"bad\">caught</b>"), 3u);
  // Submissions without an image have fewer points than "hard-coded", which has 24.
  EXPECT_LT(rows.find(">upside</a>"), rows.find(">hard-coded</a>"));
  EXPECT_EQ(count(rows, "<td class=\"first\">hidden scene hidden-mirror: same image as scene 1&apos;s</td>") +
                count(rows, "<td class=\"first\">hidden scene hidden-mirror: same image as scene 1&#39;s</td>") +
                count(rows, "<td class=\"first\">hidden scene hidden-mirror: same image as scene 1's</td>"),
            2u);
}

TEST_F(StaffPage, no_cell_is_a_dash_or_a_kind_that_only_the_record_uses) {
  const std::string page = html();
  const std::string rows = page.substr(page.find("id=\"leaderboard\""));
  EXPECT_EQ(count(rows, ">–</td>"), 0u);
  EXPECT_EQ(count(rows, "right-on-public-only"), 0u);
  EXPECT_GE(count(rows, "title=\"Every public scene is right, and a hidden one is not.\">right on public only</abbr>"),
            2u);
  EXPECT_GE(count(rows, "wrong, so not timed"), 5u);
}

TEST_F(StaffPage, large_pictures_are_links_from_where_the_page_is) {
  EXPECT_GE(count(html(), "src=\"submissions/quick/secret-lamps.png\""), 1u);
  EXPECT_GE(count(html("pages/all/staff.html"), "src=\"../../submissions/quick/secret-lamps.png\""), 1u);
}

TEST_F(StaffPage, a_picture_outside_the_folder_is_not_linked) {
  grades.submissions[0].scenes[0].pictures["image"] = "../outside.png";
  grades.submissions[1].scenes[0].pictures["image"] = "/etc/passwd";
  const std::string page = html();
  EXPECT_EQ(count(page, "src=\"../outside.png\"") + count(page, "href=\"../outside.png\""), 0u);
  EXPECT_EQ(count(page, "src=\"/etc") + count(page, "href=\"/etc"), 0u);
}

TEST_F(StaffPage, thumbnails_are_small) {
  const TemporaryFolder large;
  const Grades class_of_large = sample_grades(large.path(), sample_images(200));
  write_staff_page(class_of_large, large.path(), large.path() / "staff.html");
  // 200 pixels are reduced to 40, a fifth: far less than 5 kB for each of 16 x 5 pictures and the references.
  EXPECT_LT(std::filesystem::file_size(large.path() / "staff.html"), 1'000'000u);
}

TEST_F(StaffPage, says_what_a_run_lacks) {
  grades.interrupted = true;
  grades.contained = false;
  const std::string page = html();
  EXPECT_EQ(count(page, "Submissions ran without a sandbox."), 1u);
  EXPECT_EQ(count(page, "The run was interrupted: grades are not complete."), 1u);
}

TEST_F(StaffPage, escapes_every_text) {
  const std::string evil = "<img src=x onerror=alert(1)>\"'&{{rows}}\x1b\u202Ex";
  for (SubmissionGrade& submission : grades.submissions) {
    submission.name = submission.source = submission.sentence = submission.build_log = evil;
    submission.flags.push_back({evil, evil, evil, evil});
    for (SceneGrade& scene : submission.scenes) scene.sentence = evil;
  }
  for (GradedScene& scene : grades.scenes) scene.says = scene.reference = scene.variant = scene.unused = evil;
  grades.title = grades.command = grades.created = grades.containment = grades.speed_rule = evil;
  grades.caveats = {evil};
  grades.versions = {{evil, evil}};
  const std::string page = html();
  EXPECT_EQ(count(page, "<img src=x"), 0u);
  EXPECT_EQ(count(page, "\"'&{{"), 0u);
  EXPECT_EQ(count(page, "\u202E"), 0u);
  EXPECT_EQ(count(page, "\x1b"), 0u);
}

TEST_F(StaffPage, a_class_of_nobody_is_a_page) {
  grades.submissions.clear();
  grades.scenes.clear();
  EXPECT_EQ(count(html(), "Nothing stands out"), 1u);
}

TEST(LikenessGroups, equal_images_and_shared_noise_join_submissions) {
  Grades grades;
  grades.scenes.resize(2);
  grades.scenes[0].name = "1";
  grades.scenes[1].name = "2";
  for (const char* name : {"a", "b", "c", "d"}) {
    SubmissionGrade& submission = grades.submissions.emplace_back();
    submission.name = name;
    for (const char* scene : {"1", "2"}) {
      SceneGrade& grade = submission.scenes.emplace_back();
      grade.scene = scene;
      const bool is_copy = *name == 'a' || *name == 'c';
      GradedRun& run = grade.runs.emplace_back();
      run.checksum = is_copy ? std::string("same") + scene : name + std::string(scene);
    }
  }
  // b is like d and d like c, so all three have the same noise, although b and c were not compared.
  grades.submissions[1].flags.push_back({"same-as-other", "", "1", "d"});
  grades.submissions[3].flags.push_back({"same-as-other", "", "1", "c"});
  grades.submissions[3].flags.push_back({"same-as-other", "", "1", "nobody"});
  const std::vector<LikenessGroup> groups = likeness_groups(grades);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].names, (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(groups[0].why, "the same image, bit for bit, of scenes 1, 2");
  EXPECT_EQ(groups[1].names, (std::vector<std::string>{"b", "c", "d"}));
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades
