// The denoiser's plumbing, by the fake library's formula: what is passed, in which order, and what becomes of errors.
#include "renderer/denoising/denoiser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/denoising/test_oidn.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline renderer_denoising {
namespace {

using test::fake_oidn;
using test::partial_oidn;
using test::Variable;

constexpr int width = 5, height = 3;
const std::function<bool(double)> no_progress{};
const std::string way_to_get_it =
    "; `harness/setup/denoiser.sh` installs it and prints the folder for PHOTONPROOF_OIDN, and some systems have a "
    "package libopenimagedenoise";

/// Values in [1,2), so that the filter's scale is 1; each its own.
Image ramp(float first) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = first + static_cast<float>(i) / 64;
  return image;
}

Guides some_guides() { return {ramp(0.125f), ramp(-0.5f)}; }

/// The fake filter's formula.
float expected(const Image& colour, const Guides& guides, int x, int y, int c) {
  return 2 * colour.pixel(width - 1 - x, y)[c] + guides.albedo.pixel(x, y)[c] + 10 * guides.normal.pixel(x, y)[c];
}

class DenoiserTest : public FolderTest {};

TEST_F(DenoiserTest, colour_and_guides_go_to_the_filter_pixel_by_pixel) {
  const Image before = ramp(1);
  Image colour = before;
  const Guides guides = some_guides();
  EXPECT_FALSE(Denoiser(fake_oidn, 1).filter(colour, guides, no_progress).has_value());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(colour.pixel(x, y)[c], expected(before, some_guides(), x, y, c)) << x << " " << y << " " << c;
}

TEST_F(DenoiserTest, calls_are_those_of_the_library_s_documentation) {
  const Variable record("FAKE_OIDN_RECORD", folder_ / "calls");
  {
    const Denoiser denoiser(fake_oidn, 7);
    EXPECT_EQ(denoiser.version(), "2.3.4");
    Image colour = ramp(1);
    const Guides guides = some_guides();
    EXPECT_FALSE(denoiser.filter(colour, guides, no_progress).has_value());
  }
  EXPECT_EQ(get("calls"),
            "device of type 1\nnumThreads 7\nsetAffinity off\ncommit device\n"
            "filter RT\ncolor 5x3\nalbedo 5x3\nnormal 5x3\noutput 5x3\nhdr on\ncommit filter\nexecute\n"
            "release filter\nrelease device\n");
}

TEST_F(DenoiserTest, radiance_of_any_unit_is_filtered_alike) {
  const Guides none{Image(width, height), Image(width, height)};
  for (const int exponent : {-120, -40, 0, 40, 120}) {
    Image colour = ramp(1);
    for (float& v : colour.rgb) v = std::ldexp(v, exponent);
    const Image before = colour;
    ASSERT_FALSE(Denoiser(fake_oidn, 1).filter(colour, none, no_progress).has_value());
    EXPECT_EQ(colour.pixel(1, 2)[0], 2 * before.pixel(width - 2, 2)[0]) << exponent;
  }
}

// 44 values in [1,2) and one of 2^100 have a mean exponent of 100 / 45, as an integer 2. So the scale is 1/4, and
// guides, which are not scaled, weigh 4 times as much. A mean would make the scale 2^-94.
TEST_F(DenoiserTest, one_bright_pixel_does_not_make_the_others_black) {
  Image colour = ramp(1);
  colour.pixel(0, 0)[1] = 0x1p100f;
  const Image before = colour;
  const Guides guides = some_guides();
  ASSERT_FALSE(Denoiser(fake_oidn, 1).filter(colour, guides, no_progress).has_value());
  const float of_guides = expected(before, some_guides(), 2, 1, 1) - 2 * before.pixel(2, 1)[1];
  EXPECT_NEAR(colour.pixel(2, 1)[1] - 2 * before.pixel(2, 1)[1], 4 * of_guides, 1e-5f);
}

// A ramp is its neighbours' mean, except at the border: around the corner (4, 2) are the pixels 8, 9 and 13 of the
// ramp.
TEST_F(DenoiserTest, pixels_that_are_not_finite_are_their_neighbours_mean_for_the_filter_and_stay) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  Image colour = ramp(1);
  colour.pixel(1, 1)[2] = nan;
  colour.pixel(4, 2)[0] = -infinite;
  const Image before = colour;
  const Guides guides = some_guides();
  ASSERT_FALSE(Denoiser(fake_oidn, 1).filter(colour, guides, no_progress).has_value());
  EXPECT_EQ(colour.pixel(1, 1)[0], before.pixel(1, 1)[0]);
  EXPECT_TRUE(std::isnan(colour.pixel(1, 1)[2]));
  EXPECT_EQ(colour.pixel(4, 2)[0], -infinite);
  Image mended = ramp(1);
  for (int c = 0; c < 3; ++c) mended.pixel(4, 2)[c] = 1 + static_cast<float>(3 * 10 + c) / 64;  // (8 + 9 + 13) / 3 = 10
  for (const auto& [x, y] : {std::pair(3, 1), std::pair(0, 2), std::pair(2, 0)})
    for (int c = 0; c < 3; ++c)
      EXPECT_FLOAT_EQ(colour.pixel(x, y)[c], expected(mended, some_guides(), x, y, c)) << x << " " << y << " " << c;
}

TEST_F(DenoiserTest, image_without_a_finite_value_stays_as_it_is) {
  Image colour(2, 1);
  std::ranges::fill(colour.rgb, std::numeric_limits<float>::infinity());
  const Image before = colour;
  Guides guides{Image(2, 1), Image(2, 1)};
  ASSERT_FALSE(Denoiser(fake_oidn, 1).filter(colour, guides, no_progress).has_value());
  EXPECT_EQ(colour.rgb, before.rgb);
}

TEST_F(DenoiserTest, failure_is_told_in_the_library_s_words_and_leaves_the_colour) {
  const auto why = [](const std::string& failure) {
    const Variable fails("FAKE_OIDN", failure);
    Image colour = ramp(1);
    const Guides guides = some_guides();
    const std::optional<NotDenoised> failed = Denoiser(fake_oidn, 1).filter(colour, guides, no_progress);
    EXPECT_EQ(colour.rgb == ramp(1).rgb, failed.has_value()) << failure;
    EXPECT_FALSE(failed && failed->cancelled) << failure;
    return failed ? failed->why : "none";
  };
  EXPECT_EQ(why("memory"), "Open Image Denoise: out of memory");
  EXPECT_EQ(why("execute"), "Open Image Denoise: error 4");
  EXPECT_EQ(why("nan"), "Open Image Denoise: its result is not finite");
  EXPECT_EQ(why("nothing"), "none");
}

TEST_F(DenoiserTest, progress_is_reported_and_cancels) {
  const auto filtered = [](bool goes_on) {
    std::vector<double> seen;
    Image colour = ramp(1);
    const Guides guides = some_guides();
    const auto failed = Denoiser(fake_oidn, 1).filter(colour, guides, [&](double fraction) {
      seen.push_back(fraction);
      return goes_on;
    });
    EXPECT_EQ(seen, std::vector{0.5});
    EXPECT_EQ(colour.rgb == ramp(1).rgb, failed.has_value());
    return failed;
  };
  EXPECT_FALSE(filtered(true).has_value());
  const auto cancelled = filtered(false);
  ASSERT_TRUE(cancelled.has_value());
  EXPECT_TRUE(cancelled->cancelled);
  EXPECT_EQ(cancelled->why, "it was interrupted");
}

TEST_F(DenoiserTest, library_that_cannot_be_used_is_refused_before_anything_is_done) {
  const auto error = [](const std::string& place) { return input_error_of([&] { Denoiser(place, 1); }); };
  EXPECT_EQ(error(folder_),
            "--denoise: error: there is no libOpenImageDenoise.so.2 in '" + folder_.string() + "'" + way_to_get_it);
  EXPECT_EQ(error(folder_ / "none"),
            "--denoise: error: there is no file '" + (folder_ / "none").string() + "'" + way_to_get_it);
  put("libOpenImageDenoise.so.2", "no library");
  EXPECT_TRUE(error(folder_).starts_with("--denoise: error: Open Image Denoise cannot be loaded: " + folder_.string()))
      << error(folder_);
  const std::string partial = partial_oidn + "/libOpenImageDenoise.so.2";
  EXPECT_EQ(error(partial_oidn), "--denoise: error: '" + partial +
                                     "' has no function oidnExecuteFilter: it is not Open Image Denoise of version 2");
  EXPECT_EQ(error(partial), error(partial_oidn));
  const Variable record("FAKE_OIDN_RECORD", folder_ / "calls");
  {
    const Variable fails("FAKE_OIDN", "device");
    EXPECT_EQ(error(fake_oidn), "--denoise: error: Open Image Denoise does not run here: unsupported processor");
    EXPECT_EQ(get("calls"), "device of type 1\n");
  }
  const Variable fails("FAKE_OIDN", "commit");
  EXPECT_EQ(error(fake_oidn), "--denoise: error: Open Image Denoise does not run here: no threads");
  EXPECT_TRUE(get("calls").ends_with("commit device\nrelease device\n"));
}

}  // namespace
}  // namespace photonproof::inline renderer_denoising
