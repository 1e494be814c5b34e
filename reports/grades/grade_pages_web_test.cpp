// The pages of a grading in a browser: no console messages, working dialogs and sliders, and nothing wider than the
// page.

#include <string>

#include "reports/grades/grade_pages.h"
#include "reports/grades/test_sample_grades.h"
#include "reports/page/test_browser.h"

namespace photonproof::inline reports_grades {
namespace {

using namespace reports;

class GradePagesInBrowser : public testing::Test {
 protected:
  GradePagesInBrowser()
      : grades(sample_grades(folder.path(), sample_images(24))),
        student(folder.path() / "student.html"),
        staff(folder.path() / "staff.html") {
    for (SubmissionGrade& submission : grades.submissions) {
      if (submission.name != "no-caustic") continue;
      submission.build_log = std::string(5000, 'l') + "\n<script>console.log('broke out')</script>\n";
      submission.sentence = submission.scenes[0].sentence = std::string(300, 's');
      submission.scenes[0].runs[0].sentence = submission.source = std::string(300, 'r');
      write_student_page(grades, submission, folder.path(), student);
    }
    grades.submissions[0].name = std::string(120, 'n') + "<script>console.log('broke out')</script>";
    grades.command = grades.host.cpu = std::string(300, 'c');
    write_staff_page(grades, folder.path(), staff);
  }

  TemporaryFolder folder;
  Grades grades;
  std::filesystem::path student, staff;
};

TEST_F(GradePagesInBrowser, load_without_a_message) {
  for (const auto& page : {student, staff}) {
    const BrowserOutcome outcome = browse(page);
    for (const std::string& line : outcome.console) ADD_FAILURE() << page << ": " << line;
    EXPECT_EQ(count(outcome.dom, "</footer>"), 1u);
  }
}

TEST_F(GradePagesInBrowser, nothing_sticks_out_of_a_wide_or_narrow_window) {
  for (const auto& page : {student, staff})
    for (const int width : {1280, 390}) {
      const auto seen = drive(page, width, R"(
        for (const details of page.querySelectorAll("details")) details.open = true;
        const slide = page.querySelector(".compare-tools button");
        slide.click();
        await drawn();
        return [page.documentElement.scrollWidth, page.documentElement.clientWidth];)");
      EXPECT_LE(seen[0], seen[1]) << page << " " << width;
    }
}

TEST_F(GradePagesInBrowser, the_edge_between_submission_and_reference_moves) {
  const auto seen = drive(student, 1280, R"(
    const figures = page.querySelector(".compare"), image = figures.querySelector(".submitted img");
    const [over, marks, swap] = figures.querySelectorAll("button"), range = figures.querySelector("input");
    const look = () => [figures.classList.contains("over"), window.getComputedStyle(image).clipPath];
    const observed = [look()];
    over.click();
    observed.push(look());
    range.value = "20";
    range.dispatchEvent(new window.Event("input"));
    observed.push(look());
    swap.click();
    observed.push(look());
    const box = image.getBoundingClientRect();
    await pointer(figures.querySelector(".reference .frame"), "pointerdown", box.left + box.width / 4, box.top + 5);
    observed.push(look());
    marks.click();
    observed.push(window.getComputedStyle(figures.querySelector(".mark")).display);
    over.click();
    observed.push(look());
    return observed;)");
  const nlohmann::json expected = {{false, "none"},
                                   {true, "inset(0px 0px 0px 50%)"},
                                   {true, "inset(0px 0px 0px 20%)"},
                                   {true, "inset(0px 0px 0px 100%)"},
                                   {true, "inset(0px 0px 0px 25%)"},
                                   "none",
                                   {false, "none"}};
  EXPECT_EQ(seen, expected);
}

TEST_F(GradePagesInBrowser, a_cell_opens_its_scene_and_arrows_go_on_to_the_next) {
  const auto seen = drive(staff, 1280, R"(
    const dialog = page.querySelector("dialog"), title = () => dialog.querySelector("h3").textContent.split("\n")[0].trim().slice(0, 14);
    const name = () => dialog.querySelector("b").textContent;
    page.querySelector("a.cell").click();
    const observed = [dialog.open, name(), title()];
    await key(dialog, "ArrowRight");
    observed.push(title());
    await key(dialog, "ArrowDown");
    observed.push(name(), title(), dialog.querySelectorAll(".compare-tools").length);
    await key(dialog, "ArrowLeft");
    await key(dialog, "ArrowLeft");  // there is none further left
    observed.push(title());
    dialog.close();
    await drawn();
    observed.push(page.activeElement.getAttribute("href"));
    return observed;)");
  EXPECT_EQ(seen, (nlohmann::json{true, "quick", "scene 1 ✓ righ", "scene 2 ✓ righ", "twin-of-quick", "scene 2 ✓ righ",
                                  1, "scene 1 ✓ righ", "#s2-1"}));
}

TEST_F(GradePagesInBrowser, the_leaderboard_sorts_by_what_is_clicked) {
  const auto seen = drive(staff, 1280, R"(
    const table = page.querySelector(".leaderboard"), first = () => table.tBodies[0].rows[0].cells[5].dataset.sort;
    const observed = [first()];
    table.querySelectorAll(".sort")[5].click();
    observed.push(first());
    return observed;)");
  EXPECT_EQ(seen, (nlohmann::json{"24.8", "1.9"}));
}

TEST_F(GradePagesInBrowser, every_control_and_picture_has_a_name) {
  for (const auto& page : {student, staff}) {
    const auto seen = drive(page, 1280, R"js(
      page.querySelector("a.cell")?.click();
      const labels = (node) => [...(node.labels ?? [])].map((label) => label.textContent).join("");
      const name = (node) => node.getAttribute("aria-label") || node.alt || node.querySelector("img")?.alt || labels(node) || node.textContent;
      const nodes = [...page.querySelectorAll("button, input, [tabindex], a, dialog, summary, img:not(.cell img)")];
      const nameless = nodes.filter((node) => !name(node).trim());
      return {count: nodes.length, nameless: nameless.slice(0, 3).map((node) => node.outerHTML)};)js");
    EXPECT_GT(seen["count"], 15);
    EXPECT_EQ(seen["nameless"], nlohmann::json::array());
  }
}

TEST_F(GradePagesInBrowser, a_link_to_a_scene_opens_the_submission_it_is_in) {
  const auto seen = drive(staff, 1280, R"(
    window.location.hash = "#s3-2";
    const section = page.getElementById("s3");
    return [await until(() => section.open)];)");
  EXPECT_EQ(seen, (nlohmann::json{true}));
}

}  // namespace
}  // namespace photonproof::inline reports_grades
