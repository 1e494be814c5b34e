// Runs a small submission from its folder to its image.
#include "harness/submissions/run_submission.h"

#include <cmath>

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;
using Kind = RunOutcome::Kind;

class RunSubmission : public FolderTest {
 protected:
  void SetUp() override {
    if (const auto why = why_no_sandbox()) GTEST_SKIP() << *why;
    FolderTest::SetUp();
    fs::create_directories(folder_ / "built");
    declaration_ = {.format = SubmittedFormat::ppm, .width = 2, .height = 2};
    recipe_.limits.wall_seconds = 20;
  }
  // A built submission that is this shell script; $1 is the output.
  RunOutcome run(const std::string& script) {
    write_file_atomically(folder_ / "built" / "draw", "#!/bin/sh\n" + script);
    fs::permissions(folder_ / "built" / "draw", fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec |
                                                    fs::perms::group_read | fs::perms::others_read);
    recipe_.command = {"./draw", "{output}"};
    if (!recipe_.params_place.empty()) recipe_.command.emplace_back("{params}");
    if (!recipe_.scene_folder.empty()) recipe_.command.emplace_back("{scene}");
    return run_submission(folder_ / "built", recipe_, declaration_, folder_ / "kept", PHOTONPROOF_BINARY, handling_);
  }

  RunRecipe recipe_;
  ImageDeclaration declaration_;
  Handling handling_;
};

constexpr const char* four_pixels = "echo 'P3 2 2 255  255 0 0  0 255 0  0 0 255  51 51 51' >$1\n";

TEST_F(RunSubmission, image_is_read) {
  const RunOutcome outcome = run(four_pixels);
  ASSERT_TRUE(outcome.image) << outcome.sentence << outcome.log_tail;
  EXPECT_EQ(outcome.kind, Kind::ok);
  const std::vector<float> expected{1, 0, 0, 0, 1, 0, 0, 0, 1, 0.2f, 0.2f, 0.2f};
  EXPECT_THAT(outcome.image->rgb, testing::Pointwise(testing::FloatEq(), expected));
  EXPECT_EQ(get("kept"), "P3 2 2 255  255 0 0  0 255 0  0 0 255  51 51 51\n");
}

TEST_F(RunSubmission, files_of_the_submission_are_found_and_cannot_be_changed) {
  put("built/picture", "P3 2 2 255  255 0 0  0 255 0  0 0 255  51 51 51\n");
  const RunOutcome outcome = run("cat picture >$1; echo changed >picture; echo new >/submission/new; cat new; exit 0");
  EXPECT_EQ(outcome.kind, Kind::ok) << outcome.sentence;
  EXPECT_EQ(get("built/picture").substr(0, 2), "P3");
  EXPECT_FALSE(has("built/new"));
}

TEST_F(RunSubmission, parameters_of_the_scene_are_put_in_place_of_what_was_handed_in) {
  fs::create_directories(folder_ / "built/scenes");
  put("built/scenes/one.scene", "handed in");
  put("built/scenes/two.scene", "two");
  recipe_.params = "from the grader";
  recipe_.params_place = "scenes/one.scene";
  const RunOutcome outcome = run(std::string("cat $2 scenes/two.scene\n") + four_pixels);
  EXPECT_EQ(outcome.log_tail, "from the gradertwo");
  EXPECT_EQ(get("built/scenes/one.scene"), "handed in");
  recipe_.params_place = "../one.scene";
  EXPECT_THROW(run(four_pixels), InputError);
}

TEST_F(RunSubmission, image_that_was_handed_in_is_no_output) {
  put("built/output.ppm", "P3 1 1 255 1 1 1");
  const RunOutcome outcome = run("exit 0");
  EXPECT_EQ(outcome.kind, Kind::no_image);
  EXPECT_EQ(outcome.sentence, "output.ppm was not written");
}

TEST_F(RunSubmission, every_run_begins_anew) {
  const std::string leave = std::string("cat cache /tmp/cache /dev/shm/cache $HOME/.cache 2>/dev/null\n") +
                            "for to in . /tmp /dev/shm; do echo left >$to/cache; done; echo left >$HOME/.cache\n" +
                            four_pixels;
  EXPECT_EQ(run(leave).log_tail, "");
  EXPECT_EQ(run(leave).log_tail, "");
}

TEST_F(RunSubmission, a_scene_in_our_format_comes_with_its_files_and_cannot_be_changed) {
  for (const bool contained : {true, false}) {
    handling_.contained = contained;
    fs::create_directories(folder_ / "given");
    put("given/scene.xml", "<scene/>");
    put("given/file-1.ply", "ply");
    recipe_.scene_folder = folder_ / "given";
    const RunOutcome outcome = run(std::string("cat $2 $(dirname $2)/file-1.ply >&2\n") +
                                   (contained ? "echo other >$2 || echo kept >&2\n" : "") + four_pixels);
    EXPECT_TRUE(outcome.image) << outcome.sentence;
    EXPECT_NE(outcome.log_tail.find("<scene/>ply"), std::string::npos) << outcome.log_tail;
    if (contained) {
      EXPECT_NE(outcome.log_tail.find("kept"), std::string::npos) << outcome.log_tail;
    }
    EXPECT_EQ(get("given/scene.xml"), "<scene/>");
  }
}

TEST_F(RunSubmission, what_goes_wrong_is_said) {
  recipe_.limits.wall_seconds = 1;
  EXPECT_EQ(run("sleep 20").sentence, "the program was killed after 1 s (limit)");
  recipe_.limits.wall_seconds = 20;
  EXPECT_EQ(run("kill -SEGV $$").sentence, "the program was killed by SIGSEGV");
  EXPECT_EQ(run("exit 3").kind, Kind::crash);
  EXPECT_EQ(run("exit 3").sentence, "the program exited with 3");
  EXPECT_EQ(run("ln -s /etc/passwd $1").sentence, "output.ppm is a symbolic link, not a file");
  EXPECT_EQ(run("mkfifo $1").sentence, "output.ppm is a fifo, not a file");
  EXPECT_EQ(run("mkdir $1").sentence, "output.ppm is a directory, not a file");
  EXPECT_EQ(run(": >$1").sentence, "output.ppm is empty");
  EXPECT_EQ(run("echo BMxxxxxxxxxxxxx >$1").sentence, "output.ppm is a BMP file, not PPM");
  EXPECT_EQ(run("echo P3 3 2 255 >$1").sentence, "output.ppm is 3x2, not 2x2");
  EXPECT_EQ(run("echo hello >$1").sentence, "output.ppm is no PPM file");
  EXPECT_EQ(run("printf 'P6 2 2 255\\nabc' >$1").kind, Kind::bad_image);
}

TEST_F(RunSubmission, without_a_sandbox_the_same_image_comes_out) {
  handling_.contained = false;
  recipe_.params = "scene";
  recipe_.params_place = "a/b";
  const RunOutcome outcome = run(std::string("cat $2\n") + four_pixels);
  EXPECT_EQ(outcome.kind, Kind::ok) << outcome.sentence;
  EXPECT_EQ(outcome.log_tail, "scene");
}

TEST_F(RunSubmission, submission_is_built_with_staffs_files) {
  fs::create_directories(folder_ / "given");
  fs::create_directories(folder_ / "staff");
  put("given/Makefile", "program: program.c config.h\n\tcc -O1 -o program program.c\n");
  put("given/program.c", "#include <stdio.h>\n#include \"config.h\"\nint main(void) { puts(LEVEL); }\n");
  fs::create_symlink("program.c", folder_ / "given/config.h");
  put("staff/config.h", "#define LEVEL \"staff's\"\n");
  BuildRecipe recipe;
  recipe.command = {"make"};
  recipe.overwrite = folder_ / "staff";
  const BuildOutcome built = build_submission(folder_ / "given", recipe, folder_ / "done");
  ASSERT_TRUE(built.ok) << built.sentence << built.log_tail;
  EXPECT_TRUE(has("done/program"));
  EXPECT_FALSE(has("given/program"));
  EXPECT_EQ(get("given/config.h").substr(0, 8), "#include");
  const ProcessOutcome ran = run_process({(folder_ / "done/program").string()});
  EXPECT_EQ(ran.standard_output, "staff's\n");
  put("given/program.c", "int main(void) { return x; }\n");
  const BuildOutcome broken = build_submission(folder_ / "given", recipe, folder_ / "done2");
  EXPECT_FALSE(broken.ok);
  // The compiler's first error, not make's last line.
  EXPECT_THAT(broken.sentence, testing::MatchesRegex("the build exited with 2: program.c:1:.*error: .*undeclared.*"));
  EXPECT_THAT(broken.log_tail, testing::HasSubstr("undeclared (first use in this function)"));
  EXPECT_FALSE(has("done2"));
}

// A makefile may try the same as its program: neither sees the folders of the grader.
TEST_F(RunSubmission, hidden_scenes_and_references_are_seen_neither_by_build_nor_by_run) {
  for (const char* name : {"given", "hidden", "references"}) fs::create_directories(folder_ / name);
  put("hidden/scene.xml", "the-hidden-scene");
  put("references/one.exr", "the-reference");
  const std::string read = "cat " + (folder_ / "hidden/scene.xml").string() + " " +
                           (folder_ / "references/one.exr").string() + " /proc/*/root" + folder_.string() +
                           "/*/* 2>/dev/null; ";
  const std::string list =
      "find / -path /usr -prune -o -path /proc -prune -o -name scene.xml -print -o -name one.exr -print";
  const auto nothing = testing::Not(testing::ContainsRegex("the-hidden-scene|the-reference|scene.xml|one.exr"));
  put("given/Makefile", "all:\n\t@" + read + list + " 2>/dev/null; true\n");
  const BuildOutcome built = build_submission(folder_ / "given", {.command = {"make", "-s"}}, folder_ / "done");
  EXPECT_TRUE(built.ok) << built.sentence;
  EXPECT_THAT(built.log_tail, nothing);
  EXPECT_THAT(run(read + list + " 2>/dev/null").log_tail, nothing);
  // The same commands find them without a sandbox.
  put("given/Makefile", "all:\n\t@" + read + "true\n");
  handling_.contained = false;
  const BuildOutcome open =
      build_submission(folder_ / "given", {.command = {"make", "-s"}}, folder_ / "done2", handling_);
  EXPECT_THAT(open.log_tail, testing::HasSubstr("the-hidden-scenethe-reference"));
  EXPECT_THAT(run(read).log_tail, testing::HasSubstr("the-hidden-scenethe-reference"));
}

TEST_F(RunSubmission, build_that_never_ends_is_ended) {
  fs::create_directories(folder_ / "given");
  put("given/Makefile", "all:\n\t(setsid sleep 77 &) ; sleep 77\n");
  BuildRecipe recipe;
  recipe.command = {"make"};
  recipe.limits.wall_seconds = 1;
  const BuildOutcome built = build_submission(folder_ / "given", recipe, folder_ / "done");
  EXPECT_FALSE(built.ok);
  EXPECT_TRUE(built.timed_out);
  EXPECT_EQ(built.sentence, "the build was killed after 1 s (limit)");
}

}  // namespace
}  // namespace photonproof::inline harness_submissions
