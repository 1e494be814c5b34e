#include "harness/grading/assignment.h"

#include "harness/grading/test_course.h"

namespace photonproof::inline harness_grading {
namespace {

class AssignmentFile : public CourseTest {
 protected:
  /// The message about the course's text with `from` replaced by `to`, without the folder.
  std::string error_with(const std::string& from, const std::string& to) const {
    std::string text = course_text();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    put("bad.toml", text);
    std::string message = input_error_of([&] { read_assignment(folder_ / "bad.toml"); });
    const std::string prefix = folder_.string() + "/";
    for (std::size_t p = message.find(prefix); p != std::string::npos; p = message.find(prefix))
      message.erase(p, prefix.size());
    return message.substr(0, message.find('\n'));
  }
};

TEST_F(AssignmentFile, is_read_with_paths_from_its_folder) {
  const Assignment assignment = read_assignment(folder_ / "course.toml");
  EXPECT_EQ(assignment.name, "fake");
  EXPECT_EQ(assignment.baseline, folder_ / "handout");
  EXPECT_EQ(assignment.limits.seconds, 3);
  EXPECT_EQ(assignment.limits.memory_mb, 2048u);
  EXPECT_TRUE(assignment.seeds);
  EXPECT_EQ(assignment.image.gamma, 1.0);
  ASSERT_EQ(assignment.scenes.size(), 2u);
  EXPECT_TRUE(assignment.scenes[1].hidden);
  EXPECT_TRUE(assignment.is_timed("a"));
  EXPECT_FALSE(assignment.is_timed("b"));
  EXPECT_EQ(assignment.max_points(), 100);
  EXPECT_EQ(assignment.reference.seeds, 8);
}

TEST_F(AssignmentFile, what_it_does_not_know_is_refused_with_its_place) {
  EXPECT_EQ(error_with("seeds = true", "sedes = true"),
            "bad.toml:7:1: error: unknown key 'sedes' (did you mean 'seeds'?); known here: command, seeds");
  EXPECT_EQ(error_with("{seed}", "{sed}"),
            "bad.toml:6:34: error: unknown placeholder '{sed}' (did you mean 'seed'?); known: {scene}, {scene_option}, "
            "{name}, {width}, {height}, {output}, {threads}, {seed}, {params}");
  EXPECT_EQ(error_with("flip = 0.15", "flop = 0.15"),
            "bad.toml:16:19: error: unknown metric 'flop' (did you mean 'flip'?)");
  EXPECT_EQ(error_with("\"ppm\"", "\"gif\""),
            "bad.toml:9:10: error: 'format' is 'gif', expected exr, pfm, hdr, png, bmp, tga or ppm");
  EXPECT_EQ(error_with("timed = [\"a\"]", "timed = [\"c\"]"), "bad.toml:19:10: error: unknown scene 'c'; known: a, b");
  EXPECT_EQ(error_with("timed = [\"a\"]", "timed = [\"b\"]"),
            "bad.toml:19:10: error: scene 'b' is hidden: public ones are timed");
}

TEST_F(AssignmentFile, what_contradicts_itself_is_refused_with_its_place) {
  EXPECT_EQ(error_with("\"{output}\"", "\"x\""),
            "bad.toml:6:11: error: 'command' must have {output}, where the image is to be written");
  EXPECT_EQ(error_with("\"{seed}\"", "\"1\""), "bad.toml:7:9: error: 'seeds' is true, but the command has no {seed}");
  EXPECT_EQ(error_with("ratio = 1000", "ratio = 1.2"), "bad.toml:20:47: error: tiers ascend, in ratio and in points");
  EXPECT_EQ(error_with("rounds = 4", "curve = {best = 20, points = 60}"),
            "bad.toml:18:1: error: needs 'tiers' or 'curve', and not both");
  EXPECT_EQ(error_with("name = \"b\"", "name = \"a\""), "bad.toml:29:8: error: there is a scene 'a' already");
  EXPECT_EQ(error_with("name = \"b\"", "name = \"b\"\nof = \"a\"\nvariant = \"mirror\""),
            "bad.toml:30:6: error: a variant is made of scene 'a', which has no 'path' to a description");
  EXPECT_EQ(error_with("\"handout\"", "\"nothing\""), "bad.toml:14:14: error: no such file or folder: nothing");
  EXPECT_EQ(error_with("blocks = ", "partial = {metric = \"flip\", full = 0.3, none = 0.1}\nblocks = "),
            "bad.toml:17:48: error: 'none' must be more than 'full'");
  EXPECT_EQ(error_with("[points]", "[reference]\nfrom = \"baseline\"\nseeds = 1\n[points]"),
            "bad.toml:24:9: error: 'seeds' is 1, but the command of [run] has {seed}: expected 2 at least");
  const std::string endless(300, 'n');  // longer than any file's name
  EXPECT_EQ(error_with("\"handout\"", '"' + endless + '"'),
            "bad.toml:14:14: error: no such file or folder: " + endless);
  EXPECT_EQ(error_with("name = \"b\"", "name = \"b\"\nparams = \"course.toml\"\nparams_place = \"../x\""),
            "bad.toml:31:16: error: 'params_place' must stay inside the run's folder");
}

}  // namespace
}  // namespace photonproof::inline harness_grading
