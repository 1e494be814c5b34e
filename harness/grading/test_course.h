// A course of shell scripts, for tests only. Their images are a scene's gradient plus noise by the seed.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_grading {

class CourseTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    put_program("handout", 1);
    put("course.toml", course_text());
  }

  /// A submission: runs `first`, then makes its picture, brighter by `gain`, from $1 scene, $2 seed and $3 file.
  void put_program(const std::string& name, double gain, const std::string& first = "") const {
    std::filesystem::create_directories(folder_ / name);
    put(name + "/render",
        "#!/bin/sh\n" + first + "\nawk -v scene=\"$1\" -v seed=\"$2\" -v gain=" + std::to_string(gain) +
            " 'BEGIN { srand(seed); print \"P3 32 24 255\"; for (y = 0; y < 24; ++y) for (x = 0; x < 32; ++x) for (c = "
            "0; "
            "c < 3; ++c) { v = scene == \"a\" ? 40 + 4 * x + 10 * c : 30 + 5 * y + 12 * c; v = v * gain + 16 * (rand() "
            "+ "
            "rand() + rand() - 1.5); if (v < 0) v = 0; if (v > 255) v = 255; printf \"%d\\n\", v } }' > \"$3\"\n");
    std::filesystem::permissions(folder_ / name / "render", std::filesystem::perms::owner_all);
  }

  /// `more` ends the document, after the scenes.
  static std::string course_text(const std::string& run = "", const std::string& performance = "",
                                 const std::string& more = "") {
    return "name = \"fake\"\ntitle = \"Fake course\"\n[build]\ncommand = [\"sh\", \"-c\", \"test -x render\"]\n"
           "[run]\ncommand = [\"./render\", \"{name}\", \"{seed}\", \"{output}\"]\nseeds = true\n" +
           run +
           "[image]\nformat = \"ppm\"\ntransfer = \"linear\"\n[limits]\nseconds = 3\n"
           "[baseline]\nsubmission = \"handout\"\n"
           "[correctness]\nmetrics = {flip = 0.15}\nblocks = {relative = 0.06, alpha = 0.001}\n"
           "[performance]\ntimed = [\"a\"]\ntiers = [{ratio = 1.5, points = 20}, {ratio = 1000, points = 60}]\n"
           "rounds = 4\n" +
           performance +
           "[points]\ncorrectness = 40\n"
           "[[scene]]\nname = \"a\"\nwidth = 32\nheight = 24\n[[hidden]]\nname = \"b\"\nwidth = 32\nheight = 24\n" +
           more;
  }
};

}  // namespace photonproof::inline harness_grading
