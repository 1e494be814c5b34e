#include "scenes/description/expect.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scenes/base/input_error.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_description {
namespace {

class expect_toml : public FolderTest {
 protected:
  Expect read(const std::string& text) const {
    std::ofstream(path()) << text;
    return read_expect(path());
  }
  /// The error's text without the file's name.
  std::string message(const std::string& text) const {
    try {
      read(text);
      return "no error";
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path().size());
    }
  }
  std::string path() const { return (folder_ / "expect.toml").string(); }
};

const std::string kLeast = "purpose = \"Show it.\"\nexposure = 1\n";

TEST_F(expect_toml, needs_a_purpose_and_an_exposure_only) {
  const Expect expect = read(kLeast);
  EXPECT_EQ(expect.purpose, "Show it.");
  EXPECT_EQ(expect.exposure, 1);
  EXPECT_FALSE(expect.hdr_exposures.has_value());
  EXPECT_FALSE(expect.analytic.has_value());
  EXPECT_TRUE(expect.unsupported.empty());
  EXPECT_TRUE(expect.tolerances.empty());
}

TEST_F(expect_toml, is_read_whole) {
  const Expect expect =
      read(kLeast +
           "hdr_flip_exposures = [-2.5, 3, 6]\n"
           "[analytic]\nformula = \"L = 2\"\nmean = [2, 2.5, 3]\n"
           "[unsupported]\npovray = \"no such lens\"\n"
           "[[tolerance]]\nengine = \"povray\"\nmetric = \"bias\"\nvalue = 0.02\nreason = \"caustics\"\n"
           "[[tolerance]]\nengine = \"cycles\"\nmetric = \"bias\"\nvalue = 0.01\nblock = 0.2\nreason = \"noise\"\n");
  EXPECT_EQ(expect.hdr_exposures, (ExposureRange{-2.5, 3, 6}));
  ASSERT_TRUE(expect.analytic.has_value());
  EXPECT_EQ(expect.analytic->formula, "L = 2");
  EXPECT_EQ(*expect.analytic->mean, RgbD(2, 2.5, 3));
  EXPECT_EQ(expect.unsupported, (std::map<std::string, std::string>{{"povray", "no such lens"}}));
  ASSERT_EQ(expect.tolerances.size(), 2u);
  EXPECT_FALSE(expect.tolerances[0].block);
  EXPECT_EQ(expect.tolerances[1].block, 0.2);
  EXPECT_EQ(expect.tolerances[0].engine, "povray");
  EXPECT_EQ(expect.tolerances[0].metric, "bias");
  EXPECT_EQ(expect.tolerances[0].value, 0.02);
  EXPECT_EQ(expect.tolerances[0].reason, "caustics");
}

TEST_F(expect_toml, may_have_a_title) {
  EXPECT_EQ(message(kLeast + "title = \"\"\n"),
            ":3:9: error: 'title' must be a text that is not empty\n  title = \"\"\n          ^");
  EXPECT_EQ(read("title = \"Cornell box\"\n" + kLeast).title, "Cornell box");
  EXPECT_EQ(read(kLeast).title, "");
}

TEST_F(expect_toml, is_refused_with_the_place_and_what_was_expected) {
  EXPECT_EQ(message("exposure = 0\n"), ":1:1: error: expect.toml needs the key 'purpose'\n  exposure = 0\n  ^");
  EXPECT_EQ(message("purpose = \"x\"\n"), ":1:1: error: expect.toml needs the key 'exposure'\n  purpose = \"x\"\n  ^");
  EXPECT_EQ(message("purpose = 3\nexposure = 0\n"),
            ":1:11: error: 'purpose' must be a text that is not empty\n  purpose = 3\n            ^");
  EXPECT_EQ(message("purpose = \"x\"\nexposure = \"0\"\n"),
            ":2:12: error: 'exposure' must be a finite number\n  exposure = \"0\"\n             ^");
  EXPECT_EQ(message("purpose = \"x\"\nexposure = nan\n"),
            ":2:12: error: 'exposure' must be a finite number\n  exposure = nan\n             ^");
  EXPECT_EQ(
      message(kLeast + "exposures = 2\n"),
      ":3:1: error: expect.toml has no key 'exposures' (did you mean 'exposure'?), expected title, purpose, exposure, "
      "hdr_flip_exposures, analytic, unsupported, tolerance, povray or cycles\n  exposures = 2\n  ^");
  EXPECT_EQ(message(kLeast + "hdr_flip_exposures = 4\n"),
            ":3:22: error: 'hdr_flip_exposures' must be a list of start, stop and count\n  hdr_flip_exposures = 4\n"
            "                       ^");
  EXPECT_EQ(message(kLeast + "hdr_flip_exposures = [-1, 2, 2.5]\n"),
            ":3:30: error: the count of 'hdr_flip_exposures' must be a whole number\n"
            "  hdr_flip_exposures = [-1, 2, 2.5]\n                               ^");
  EXPECT_EQ(message(kLeast + "hdr_flip_exposures = [-1, \"2\", 2]\n"),
            ":3:27: error: 'hdr_flip_exposures' must be a finite number\n"
            "  hdr_flip_exposures = [-1, \"2\", 2]\n                            ^");
  // From last to first, beyond 64 stops, and no exposure, or too many.
  for (const char* list :
       {"[2, -1, 2]", "[-65, 2, 2]", "[-1, 65, 2]", "[-1, 2, 0]", "[-1, 2, 101]", "[-1, 2, 4294967298]"})
    EXPECT_EQ(
        message(kLeast + "hdr_flip_exposures = " + list + "\n"),
        ":3:22: error: 'hdr_flip_exposures': expected a first and a last exposure from -64 to 64 and their number "
        "from 1 to 100\n  hdr_flip_exposures = " +
            std::string(list) + "\n                       ^");
  EXPECT_EQ(message(kLeast + "[analytic]\nmean = [1, 1, 1]\n"),
            ":3:1: error: [analytic] needs the key 'formula'\n  [analytic]\n  ^");
  EXPECT_EQ(message(kLeast + "[analytic]\nformula = \"x\"\nmean = [1, 1]\n"),
            ":5:8: error: 'mean' must be a list of three numbers\n  mean = [1, 1]\n         ^");
  EXPECT_EQ(message(kLeast + "[tolerance]\nvalue = 1\n"),
            ":3:1: error: [[tolerance]] must be a list of tables\n  [tolerance]\n  ^");
  EXPECT_EQ(message(kLeast + "[[tolerance]]\nengine = \"e\"\nmetric = \"m\"\nvalue = 0\nreason = \"r\"\n"),
            ":3:1: error: 'value' must be more than 0\n  [[tolerance]]\n  ^");
  EXPECT_EQ(message(kLeast + "[[tolerance]]\nengine = \"e\"\nmetric = \"m\"\nvalue = 1\nblock = 0\nreason = \"r\"\n"),
            ":3:1: error: 'block' must be more than 0\n  [[tolerance]]\n  ^");
  EXPECT_EQ(message(kLeast + "[unsupported]\npovray = true\n"),
            ":4:10: error: 'povray' must be a text that is not empty\n  povray = true\n           ^");
}

const std::string kPovray = "[povray]\nsize = 96\nquality = 2\nrelmse = 1e-3\nseconds = 1.5\n";

TEST_F(expect_toml, says_how_far_povray_is_off_and_why_where_that_is_much) {
  const Expect small = read(kLeast + kPovray + "mean_percent = -0.4\nssim = 0.99\n");
  ASSERT_TRUE(small.povray.has_value());
  EXPECT_EQ(small.povray->size, 96);
  EXPECT_EQ(small.povray->quality, 2);
  EXPECT_EQ(small.povray->relmse, 1e-3);
  EXPECT_EQ(small.povray->seconds, 1.5);
  EXPECT_EQ(small.povray->mean_percent, -0.4);
  EXPECT_EQ(small.povray->ssim, 0.99);
  EXPECT_FALSE(small.povray->cause.has_value());
  const std::string needs =
      ":3:1: error: [povray] needs a 'cause': its mean is off by more than 0.5 % or its ssim below 0.98\n  [povray]\n  "
      "^";
  EXPECT_EQ(message(kLeast + kPovray + "mean_percent = 0.6\nssim = 0.99\n"), needs);
  EXPECT_EQ(message(kLeast + kPovray + "mean_percent = -0.6\nssim = 0.99\n"), needs);
  EXPECT_EQ(message(kLeast + kPovray + "mean_percent = 0\nssim = 0.97\n"), needs);
  EXPECT_EQ(read(kLeast + kPovray + "mean_percent = 0\nssim = 0.97\ncause = \"noise\"\n").povray->cause, "noise");
}

const std::string kCycles = "[cycles]\nsize = 64\nspp = 1024\nrelmse = 1e-3\nssim = 0.9\nseconds = 9\n";

TEST_F(expect_toml, says_how_far_cycles_is_off_beside_its_noise) {
  const Expect small = read(kLeast + kCycles + "mean_percent = -0.3\nnoise_percent = 0.05\n");
  ASSERT_TRUE(small.cycles.has_value());
  EXPECT_EQ(small.cycles->size, 64);
  EXPECT_EQ(small.cycles->spp, 1024);
  EXPECT_EQ(small.cycles->mean_percent, -0.3);
  EXPECT_EQ(small.cycles->noise_percent, 0.05);
  EXPECT_EQ(small.cycles->seconds, 9);
  EXPECT_TRUE(read(kLeast + kCycles + "mean_percent = 2.9\nnoise_percent = 1\n").cycles->is_small());
  const std::string far = kLeast + kCycles + "mean_percent = 0.31\nnoise_percent = 0.1\n";
  EXPECT_EQ(message(far),
            ":3:1: error: [cycles] needs a 'cause': its mean is off by more than 0.3 % and by more than three standard "
            "errors\n  [cycles]\n  ^");
  EXPECT_EQ(read(far + "cause = \"facets\"\n").cycles->cause, "facets");
}

TEST_F(expect_toml, says_how_far_the_means_of_several_images_are_off) {
  const std::string noisy = kLeast + kCycles + "mean_percent = 2.9\nnoise_percent = 1\n";
  const Expect expect = read(noisy + "pairs = {count = 9, mean_percent = -0.3, noise_percent = 0.05}\n");
  ASSERT_TRUE(expect.cycles->pairs.has_value());
  EXPECT_EQ(expect.cycles->pairs->count, 9);
  EXPECT_EQ(expect.cycles->pairs->mean_percent, -0.3);
  EXPECT_EQ(expect.cycles->pairs->noise_percent, 0.05);
  EXPECT_FALSE(read(noisy).cycles->pairs.has_value());
  EXPECT_EQ(message(noisy + "pairs = {count = 9, mean_percent = -0.31, noise_percent = 0.1}\n"),
            ":3:1: error: [cycles] needs a 'cause': its mean is off by more than 0.3 % and by more than three standard "
            "errors\n  [cycles]\n  ^");
  EXPECT_EQ(
      message(noisy + "pairs = {count = 9, mean_percent = 0}\n"),
      ":11:9: error: 'pairs' needs the key 'noise_percent'\n  pairs = {count = 9, mean_percent = 0}\n          ^");
}

TEST_F(expect_toml, that_is_no_toml_is_refused_with_its_place) {
  EXPECT_EQ(message("purpose = \"x\"\nexposure 0\n").rfind(":2:", 0), 0u) << message("purpose = \"x\"\nexposure 0\n");
}

TEST_F(expect_toml, that_is_missing_is_refused_by_name) {
  try {
    read_expect("/nowhere/expect.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/expect.toml: error: no such file");
  }
}

TEST(expect_path_of, is_beside_the_scene) {
  EXPECT_EQ(expect_path_of("a/b/scene.xml"), "a/b/expect.toml");
  EXPECT_EQ(expect_path_of("scene.xml"), "expect.toml");
}

}  // namespace
}  // namespace photonproof::inline scenes_description
