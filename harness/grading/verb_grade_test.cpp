// Tests the program with a class of shell scripts: grading continues whatever they do, and after it was killed.

#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "harness/cells/test_program.h"
#include "harness/grading/test_course.h"
#include "reports/grades/grades_json.h"
#include "scenes/base/process.h"
#include "scenes/images/image.h"
#include "scenes/records/test_schema_check.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

const std::string gradescope_schema = read_file(PHOTONPROOF_SOURCE_DIR "/reports/grades/gradescope.schema.json");

class GradeVerb : public CourseTest {
 protected:
  std::vector<std::string> command(const std::vector<std::string>& submissions,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "grade",       folder_ / "course.toml", "-o",
                                  folder_ / "out",    "--no-sandbox"};
    for (const std::string& name : submissions) argv.push_back(folder_ / name);
    argv.insert(argv.end(), more.begin(), more.end());
    return argv;
  }
  ProcessOutcome grade(const std::vector<std::string>& submissions, const std::vector<std::string>& more = {}) const {
    return run_process(command(submissions, more), {.wall_limit_seconds = 200});
  }
  Grades grades() const { return grades_from_json(nlohmann::ordered_json::parse(get("out/grades.json")), "grades"); }
  const SubmissionGrade& of(const Grades& grades, const std::string& name) const {
    for (const SubmissionGrade& submission : grades.submissions)
      if (submission.name == name) return submission;
    throw std::out_of_range(name);
  }
  std::size_t cells() const {
    std::error_code none;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out" / "cells", none))
      if (fs::exists(entry.path() / "cell.json")) ++count;
    return count;
  }
};

TEST_F(GradeVerb, a_right_and_quick_submission_has_its_points) {
  put_program("handout", 1, "sleep 0.3");
  put_program("honest", 1);
  const ProcessOutcome outcome = grade({"honest"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const Grades all = grades();
  const SubmissionGrade& honest = all.submissions.at(0);
  for (const SceneGrade& scene : honest.scenes) EXPECT_EQ(scene.verdict, SceneVerdict::right) << scene.sentence;
  EXPECT_EQ(honest.correctness_points, 40);
  // The baseline sleeps longer than it computes. On a busy machine the verdict is "too noisy", with the points of the
  // same tier.
  EXPECT_GT(honest.speed.speedup.value, 1.5) << honest.speed.sentence;
  EXPECT_EQ(honest.speed.points, 20) << honest.speed.sentence;
  EXPECT_TRUE(has("out/gradebook.csv"));
  EXPECT_TRUE(has("out/" + honest.scenes[0].pictures.at("flip")));
  EXPECT_EQ(schema_problem(gradescope_schema, get("out/" + honest.folder + "/results.json")), "");
  EXPECT_NE(outcome.standard_output.find("honest"), std::string::npos);
  ASSERT_EQ(all.caveats.size(), 1u);
  EXPECT_EQ(all.caveats[0], "submissions ran without a sandbox (--no-sandbox)");
}

TEST_F(GradeVerb, whatever_a_submission_does_is_said_of_it_and_grading_goes_on) {
  put_program("dim", 0.7);
  put_program("crash", 1, "echo lost >&2; kill -SEGV $$");
  put_program("hang", 1, "sleep 60");
  put_program("silent", 1, "exit 0");
  put_program("small", 1, "printf 'P3 2 2 255 1 1 1 1 1 1 1 1 1 1 1 1' > \"$3\"; exit 0");
  put_program("public", 1,
              "[ \"$1\" = b ] && { awk 'BEGIN { print \"P3 32 24 255\"; for (i = 0; i < 2304; ++i) print 0 }' > "
              "\"$3\"; exit 0; }");
  put_program("constant", 1, "set \"$1\" 5 \"$3\"");
  fs::create_directories(folder_ / "broken");
  put("broken/readme", "no program");
  put_program("honest", 1);
  // The limit is 30 times what a picture takes. The one that hangs reaches it twice on each scene.
  std::string course = course_text();
  const std::string limit = "seconds = 3\n";
  put("course.toml", course.replace(course.find(limit), limit.size(), "seconds = 1\n"));
  const ProcessOutcome outcome =
      grade({"dim", "crash", "hang", "silent", "small", "public", "constant", "broken", "honest"}, {"--no-timing"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const Grades all = grades();
  EXPECT_EQ(of(all, "dim").scenes[0].verdict, SceneVerdict::wrong);
  EXPECT_EQ(of(all, "crash").scenes[0].verdict, SceneVerdict::failed);
  EXPECT_NE(of(all, "crash").sentence.find("SIGSEGV"), std::string::npos) << of(all, "crash").sentence;
  EXPECT_EQ(of(all, "hang").scenes[0].runs[0].end, "timeout");
  EXPECT_EQ(of(all, "silent").scenes[0].runs[0].end, "no image");
  EXPECT_EQ(of(all, "small").scenes[0].runs[0].end, "bad image") << of(all, "small").sentence;
  EXPECT_EQ(of(all, "public").sentence,
            "right on the public scenes only: 1 of 1 hidden ones is not (b: the image is black)");
  EXPECT_EQ(of(all, "public").correctness_points, 20);
  ASSERT_FALSE(of(all, "constant").flags.empty());
  EXPECT_EQ(of(all, "constant").flags[0].sentence, "scene a: the same image for two seeds");
  EXPECT_FALSE(of(all, "broken").built);
  EXPECT_EQ(of(all, "broken").points(), 0);
  EXPECT_EQ(of(all, "honest").correctness_points, 40) << of(all, "honest").sentence;
}

TEST_F(GradeVerb, scene_that_is_left_out_is_skipped) {
  put_program("honest", 1);
  fs::create_directories(folder_ / "broken");
  put("broken/readme", "no program");
  ASSERT_EQ(grade({"honest", "broken"}, {"--no-timing", "--scene", "a"}).exit_code, 0);
  const Grades all = grades();
  for (const char* name : {"honest", "broken"}) {
    EXPECT_EQ(of(all, name).scenes[1].verdict, SceneVerdict::skipped) << name;
    EXPECT_EQ(of(all, name).scenes[1].sentence, "--scene leaves it out") << name;
  }
  EXPECT_EQ(of(all, "honest").sentence, "right on the one scene");
  EXPECT_EQ(of(all, "honest").correctness_points, 40);
  EXPECT_NE(get("out/gradebook.csv").find(",right,skipped,"), std::string::npos) << get("out/gradebook.csv");
}

TEST_F(GradeVerb, one_image_for_two_scenes_is_named) {
  put_program("stuck", 1, "set a 5 \"$3\"");
  ASSERT_EQ(grade({"stuck"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  EXPECT_EQ(all.submissions[0].scenes[1].sentence, "same image as scene a's");
  EXPECT_EQ(all.submissions[0].sentence, "hidden scene b: same image as scene a's");
}

// In its own folder each run is honest; in a used one, the keeper's earlier image comes back.
TEST_F(GradeVerb, results_kept_from_an_earlier_run_are_told_from_scratch_files) {
  put_program("keeper", 1, "[ -f kept ] && { cp kept \"$3\"; exit; }; trap 'cp \"'\"$3\"'\" kept' EXIT");
  put_program("scribbler", 1, "date > kept");
  ASSERT_EQ(grade({"keeper", "scribbler"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  EXPECT_EQ(of(all, "keeper").sentence,
            "scene a: an earlier run's image comes back, whatever the seed: results are kept in files");
  EXPECT_EQ(of(all, "keeper").correctness_points, 20);
  EXPECT_TRUE(of(all, "scribbler").flags.empty());
  EXPECT_EQ(of(all, "scribbler").correctness_points, 40);
}

// The finder and the patient are right where there is nothing to find; the loafer is wrong, and never twice the same.
TEST_F(GradeVerb, copies_of_what_lies_around_and_images_of_chance_are_named) {
  put_program("finder", 1, "for i in \"$TMPDIR\"/*.ppm; do [ -f \"$i\" ] && { cp \"$i\" \"$3\"; exit; }; done");
  put_program("patient", 1, "set \"$1\" $(($2 + $(date +1%N) % 1000000)) \"$3\"");
  put_program("loafer", 1,
              "awk 'BEGIN { srand('$(date +%N)'); print \"P3 32 24 255\"; for (i = 0; i < 2304; ++i) print "
              "int(50 * rand()) }' > \"$3\"; exit");
  ASSERT_EQ(grade({"finder", "patient", "loafer"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  EXPECT_EQ(of(all, "finder").sentence,
            "scene a: an earlier run's image comes back, whatever the seed: images that lie in the folder for "
            "temporary files are copied");
  EXPECT_EQ(of(all, "finder").correctness_points, 20);
  EXPECT_TRUE(of(all, "patient").flags.empty());
  EXPECT_EQ(of(all, "patient").correctness_points, 40);
  ASSERT_EQ(of(all, "loafer").flags.size(), 1u);
  EXPECT_EQ(of(all, "loafer").flags[0].sentence,
            "scene a: the same seed gives another image every time: it goes by the clock, or threads race");
}

// Staff's file replaces each submission's. Both are too dark; one of them does not read the file.
TEST_F(GradeVerb, parameters_that_are_not_heeded_are_named) {
  const std::string heed = "[ $(cat parameters) = 40 ] && set \"$1\" $(($2 + 1)) \"$3\"";
  std::string course = course_text();
  const std::string build = "\"test -x render\"]\n";
  put("course.toml", course.insert(course.find(build) + build.size(), "overwrite = \"staff\"\n"));
  put_program("handout", 1, heed);
  put_program("heeds", 0.5, heed);
  put_program("ignores", 0.4);
  fs::create_directory(folder_ / "staff");
  put("staff/parameters", "10");
  for (const char* name : {"handout", "heeds", "ignores"}) put(std::string(name) + "/parameters", "40");
  ASSERT_EQ(grade({"heeds", "ignores"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  EXPECT_TRUE(of(all, "heeds").flags.empty()) << of(all, "heeds").flags.front().kind;
  EXPECT_EQ(of(all, "ignores").sentence,
            "the same image with other parameters: files that the assignment puts in place of the submission's own are "
            "ignored");
}

TEST_F(GradeVerb, a_copied_reference_is_wrong_though_every_metric_likes_it) {
  ASSERT_EQ(grade({"handout"}, {"--no-timing"}).exit_code, 0);
  const Image reference = read_image((folder_ / "out" / "references" / "a.exr").string());
  std::string ppm = "P3 32 24 255\n";
  for (const float v : reference.rgb) ppm += std::to_string(static_cast<int>(v * 255 + 0.5f)) + "\n";
  put_program("copy", 1, "cp a.ppm \"$3\"; exit 0");
  put("copy/a.ppm", ppm);
  ASSERT_EQ(grade({"copy"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  EXPECT_EQ(all.submissions[0].scenes[0].sentence, "a copy of the reference: it has the reference's own noise");
  EXPECT_EQ(all.submissions[0].scenes[0].points, 0);
}

TEST_F(GradeVerb, two_teams_with_the_same_noise_are_flagged_and_keep_their_points) {
  put_program("one", 1, "set \"$1\" $(($2 + 1)) \"$3\"");
  put_program("two", 1, "set \"$1\" $(($2 + 1)) \"$3\"; true");
  put_program("three", 1, "set \"$1\" $(($2 + 2)) \"$3\"");
  ASSERT_EQ(grade({"one", "two", "three"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  ASSERT_EQ(of(all, "one").flags.size(), 1u);
  EXPECT_EQ(of(all, "one").flags[0].sentence, "the same noise as two's images, on 2 scenes");
  EXPECT_EQ(of(all, "one").correctness_points, 40);
  EXPECT_TRUE(of(all, "three").flags.empty());
}

TEST_F(GradeVerb, other_images_while_it_is_timed_cost_the_points_for_speed) {
  // The counter is outside of the run's folder, which only a program without a sandbox can use.
  put_program("sly", 1,
              "n=$(cat " + (folder_ / "count").string() + " 2>/dev/null || echo 0); echo $((n + 1)) > " +
                  (folder_ / "count").string() + "; [ $n -ge 3 ] && set b \"$2\" \"$3\"");
  ASSERT_EQ(grade({"sly"}, {"--threads", "1"}).exit_code, 0);
  const Grades all = grades();
  EXPECT_EQ(all.submissions[0].speed.state, SpeedGrade::State::changed) << all.submissions[0].speed.sentence;
  EXPECT_EQ(all.submissions[0].speed.points, 0);
}

// The timed scene a is fast, the hidden one b as slow as the baseline; every image is right.
TEST_F(GradeVerb, a_program_that_is_fast_on_timed_scenes_alone_is_flagged) {
  put_program("handout", 1, "sleep 0.5");
  put_program("special", 1, "[ \"$1\" = b ] && sleep 0.5");
  put_program("honest", 1);
  // Programs that sleep do not slow each other down; those that are timed run alone in any case.
  ASSERT_EQ(grade({"special", "honest"}, {"--threads", "8"}).exit_code, 0);
  const Grades all = grades();
  const SubmissionGrade& special = of(all, "special");
  EXPECT_EQ(special.correctness_points, 40) << special.sentence;
  ASSERT_EQ(special.flags.size(), 1u);
  EXPECT_EQ(special.flags[0].kind, "fast-on-timed-only");
  EXPECT_EQ(special.flags[0].scene, "b");
  EXPECT_THAT(special.sentence, testing::StartsWith("hidden scene b: "));
  EXPECT_THAT(special.speed.sentence, testing::HasSubstr(special.flags[0].sentence));
  EXPECT_TRUE(of(all, "honest").flags.empty()) << of(all, "honest").flags.front().sentence;
}

TEST_F(GradeVerb, wrong_images_keep_a_share_of_the_points_where_the_assignment_says_so) {
  std::string course = course_text();
  const std::string metrics = "metrics = {flip = 0.15}\n";
  course.insert(course.find(metrics) + metrics.size(), "partial = {metric = \"bias\", full = 0.1, none = 0.5}\n");
  put("course.toml", course);
  put_program("dim", 0.7);
  put_program("dark", 0.4);
  put_program("copies", 1, "cp a.ppm \"$3\"; exit 0");
  ASSERT_EQ(grade({"dim", "dark"}, {"--no-timing"}).exit_code, 0);
  const Grades all = grades();
  // A bias of -0.3 is halfway between 0.1 and 0.5; the reference is clamped at no pixel.
  EXPECT_EQ(of(all, "dim").scenes[0].verdict, SceneVerdict::wrong);
  EXPECT_NEAR(of(all, "dim").scenes[0].points, 10, 0.5);
  EXPECT_EQ(of(all, "dark").correctness_points, 0);
}

// The baseline has no randomness for any seed: one render is its reference.
TEST_F(GradeVerb, one_render_is_the_reference_of_a_baseline_without_randomness) {
  std::string course = course_text("", "", "[reference]\nfrom = \"baseline\"\nseeds = 1\n");
  course.replace(course.find("seeds = true"), 12, "seeds = false");
  put("course.toml", course);
  put_program("handout", 1, "set \"$1\" 1 \"$3\"");
  put_program("honest", 1, "set \"$1\" 1 \"$3\"; true");
  put_program("dim", 0.7, "set \"$1\" 1 \"$3\"");
  const ProcessOutcome outcome = grade({"honest", "dim"}, {"--no-timing"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const Grades all = grades();
  EXPECT_EQ(all.scenes[0].reference, "a render by the baseline, which has no randomness");
  EXPECT_EQ(of(all, "honest").correctness_points, 40) << of(all, "honest").sentence;
  EXPECT_EQ(of(all, "dim").scenes[0].verdict, SceneVerdict::wrong);
  put_program("handout", 1);  // uses the seed
  const ProcessOutcome random = grade({"honest"}, {"--no-timing"});
  EXPECT_EQ(random.exit_code, 2);
  EXPECT_EQ(random.standard_error,
            "baseline: error: gives two images of scene 'a', so that one render is no reference: leave out 'seeds' in "
            "[reference]\n");
}

TEST_F(GradeVerb, killed_it_has_lost_at_most_what_was_running_and_resumes) {
  put_program("honest", 1);
  put_program("dim", 0.7);
  const auto argv = command({"honest", "dim"}, {"--no-timing"});
  const pid_t pid = start_program(argv, folder_ / "err");
  signal_after(pid, SIGKILL, 10, 0, [&] { return cells(); });
  const std::size_t kept = cells();
  EXPECT_GE(kept, 8u);
  EXPECT_FALSE(has("out/grades.json"));
  ASSERT_EQ(grade({"honest", "dim"}, {"--no-timing", "--resume"}).exit_code, 0);
  const std::size_t resumed = cells();
  const std::string verdicts = get("out/gradebook.csv");
  // A grading from scratch has the same verdicts and as many runs.
  fs::remove_all(folder_ / "out");
  ASSERT_EQ(grade({"honest", "dim"}, {"--no-timing"}).exit_code, 0);
  EXPECT_EQ(get("out/gradebook.csv"), verdicts);
  EXPECT_EQ(cells(), resumed);
}

TEST_F(GradeVerb, graded_again_it_keeps_references_and_runs_submissions_anew) {
  put_program("honest", 1);
  ASSERT_EQ(grade({"honest"}, {"--no-timing"}).exit_code, 0);
  const std::size_t first = cells();
  const std::string verdicts = get("out/gradebook.csv");
  ASSERT_EQ(grade({"honest"}, {"--no-timing"}).exit_code, 0);
  EXPECT_EQ(cells(), 2 * first - 16);  // all except the 8 runs of each of 2 references
  EXPECT_EQ(get("out/gradebook.csv"), verdicts);
}

TEST_F(GradeVerb, interrupted_it_says_so_and_keeps_what_there_is) {
  put_program("honest", 1);
  const pid_t pid = start_program(command({"honest"}, {"--no-timing"}), folder_ / "err");
  const int status = signal_after(pid, SIGINT, 3, 0, [&] { return cells(); });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const Grades all = grades();
  EXPECT_TRUE(all.interrupted);
  EXPECT_EQ(of(all, "honest").sentence, "not graded: the grading was interrupted");
}

TEST_F(GradeVerb, what_cannot_be_graded_is_said_before_anything_runs) {
  const auto error = [&](const std::vector<std::string>& names, const std::vector<std::string>& more = {}) {
    const ProcessOutcome outcome = grade(names, more);
    EXPECT_EQ(outcome.exit_code, 2);
    std::string text = outcome.standard_error;
    for (std::size_t at = text.find(folder_.string()); at != std::string::npos; at = text.find(folder_.string()))
      text.erase(at, folder_.string().size() + 1);
    return text;
  };
  EXPECT_EQ(error({"nobody"}), "nobody: error: no such file or folder\n");
  EXPECT_EQ(error({"handout", "handout"}), "handout: error: there is another submission 'handout'\n");
  EXPECT_EQ(error({"handout"}, {"--only", "x"}), "--only: error: no submission's name contains 'x'\n");
  EXPECT_EQ(error({"handout"}, {"--scene", "c"}), "--scene: error: unknown scene 'c'; known: a, b\n");
  EXPECT_EQ(error({}), "submissions: error: there are none to grade\n");
  EXPECT_EQ(cells(), 0u);
}

// A program has to render width x height pixels; black around a crop would count as right.
TEST_F(GradeVerb, scenes_that_render_a_part_of_the_film_are_refused) {
  std::string scene = read_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/furnace/scene.xml", 1 << 20);
  scene.insert(scene.find("</film>"),
               "<integer name='crop_offset_x' value='8'/><integer name='crop_offset_y' value='6'/>"
               "<integer name='crop_width' value='24'/><integer name='crop_height' value='16'/>");
  put("scene.xml", scene);
  put("course.toml", course_text("", "", "[[hidden]]\nname = \"c\"\npath = \"scene.xml\"\nwidth = 64\nheight = 64\n"));
  const ProcessOutcome outcome = grade({"handout"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.standard_error.find("scene.xml: error: renders "), std::string::npos) << outcome.standard_error;
  EXPECT_NE(outcome.standard_error.find("crop_*"), std::string::npos) << outcome.standard_error;
  EXPECT_EQ(cells(), 0u);
}

TEST_F(GradeVerb, a_baseline_that_does_not_run_ends_it) {
  put_program("handout", 1, "exit 3");
  put_program("honest", 1);
  const ProcessOutcome outcome = grade({"honest"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error.rfind("baseline: error: has no image of scene 'a': ", 0), 0u)
      << outcome.standard_error;
}

TEST_F(GradeVerb, the_autograder_has_what_gradescope_asks_for) {
  const ProcessOutcome outcome = run_process({PHOTONPROOF_BINARY, "grade", folder_ / "course.toml", "--autograder",
                                              folder_ / "autograder.zip", "--no-sandbox"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_NE(("\n" + outcome.standard_output).find("\n  assignment/course.toml\n"), std::string::npos)
      << outcome.standard_output;
  put_program("submission", 1);
  // Unpacked and run as Gradescope does.
  const std::string place = (folder_ / "autograder").string();
  const ProcessOutcome run = run_process(
      {"sh", "-ec",
       "mkdir -p $0/source; cd $0/source; python3 -m zipfile -e ../../autograder.zip .; chmod +x run_autograder "
       "bin/photonproof assignment/*/render; cp -r ../../submission ..; AUTOGRADER=$0 ./run_autograder",
       place});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(schema_problem(gradescope_schema, get("autograder/results/results.json")), "");
  EXPECT_NE(get("autograder/source/setup.sh").find("apt-get install"), std::string::npos);
}

// The folder has other submissions and a note, which students' machines must not get. The scene names a mesh, and a
// file that does not exist.
TEST_F(GradeVerb, the_autograder_has_the_files_that_the_assignment_and_its_scenes_name) {
  put_program("other-submission", 1);
  put("answers.txt", "all hidden scenes are furnaces");
  put("box.obj", "mtllib box.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  put("box.mtl", "newmtl a\nmap_Kd wood.png\n");
  put("wood.png", "not read here");
  std::string scene = read_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/furnace/scene.xml", 1 << 20);
  scene.insert(scene.rfind("</scene>"),
               "<shape type='obj'><string name='filename' value=\"box.obj\"/></shape><!-- \"absent.png\" -->");
  put("scene.xml", scene);
  put("course.toml", course_text("", "", "[[hidden]]\nname = \"c\"\npath = \"scene.xml\"\nwidth = 64\nheight = 64\n"));
  const ProcessOutcome outcome =
      run_process({PHOTONPROOF_BINARY, "grade", folder_ / "course.toml", "--autograder", folder_ / "autograder.zip"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const std::string list = "\n" + outcome.standard_output;
  for (const char* name : {"course.toml", "scene.xml", "box.obj", "box.mtl", "wood.png"})
    EXPECT_NE(list.find("\n  assignment/" + std::string(name) + "\n"), std::string::npos) << name << "\n" << list;
  for (const char* name : {"other-submission", "answers", "absent"})
    EXPECT_EQ(list.find(name), std::string::npos) << name << "\n" << list;
}

// A program that says why it cannot grade, as where user namespaces are denied.
TEST_F(GradeVerb, the_autograder_tells_why_it_cannot_grade) {
  const ProcessOutcome outcome =
      run_process({PHOTONPROOF_BINARY, "grade", folder_ / "course.toml", "--autograder", folder_ / "autograder.zip"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const std::string place = (folder_ / "autograder").string();
  const ProcessOutcome run = run_process(
      {"sh", "-ec",
       "mkdir -p $0/source; cd $0/source; python3 -m zipfile -e ../../autograder.zip .; chmod +x run_autograder; "
       "printf '#!/bin/sh\\necho one; echo \"bwrap: no \\\\\"namespaces\\\\\"\" >&2; exit 2\\n' >bin/photonproof; "
       "chmod +x bin/photonproof; AUTOGRADER=$0 ./run_autograder",
       place});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const std::string results = get("autograder/results/results.json");
  EXPECT_EQ(schema_problem(gradescope_schema, results), "") << results;
  EXPECT_NE(results.find(R"((exit code 2): bwrap: no \"namespaces\". The submission is not at fault.)"),
            std::string::npos)
      << results;
}

}  // namespace
}  // namespace photonproof::inline harness_grading
