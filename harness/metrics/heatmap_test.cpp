#include "harness/metrics/heatmap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "harness/metrics/test_images.h"
#include "harness/pixels/display.h"
#include "reports/record/heatmap_magma.h"
#include "scenes/base/input_error.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_metrics {
namespace {

namespace fs = std::filesystem;

using HeatmapFilesTest = FolderTest;

TEST(Heatmap, flip_scale_is_linear_from_zero_to_one) {
  EXPECT_EQ(flip_shade(0), 0);
  EXPECT_EQ(flip_shade(1), 255);
  EXPECT_EQ(flip_shade(0.5f), 128);  // 127.5 rounds up
  EXPECT_EQ(flip_shade(51.2f / 255), 51);
}

TEST(Heatmap, error_scale_takes_a_sixth_of_the_map_for_a_decade_and_clamps_beyond) {
  // 1e-4 ... 1e2: 1 lies at 4/6 of the map, entry 170.
  EXPECT_EQ(error_shade(0), 0);
  EXPECT_EQ(error_shade(1e-5f), 0);
  EXPECT_EQ(error_shade(1e-4f), 0);
  EXPECT_EQ(error_shade(1), 170);
  EXPECT_EQ(error_shade(1e2f), 255);
  EXPECT_EQ(error_shade(1e9f), 255);
}

TEST(Heatmap, colour_map_grows_lighter_from_entry_to_entry) {
  // Relative luminance (weights of Rec.709) may stay level or fall by a byte's rounding, but not by more.
  const auto luminance = [](std::uint32_t colour) {
    const auto channel = [&](int shift) { return decode_srgb((colour >> shift & 0xff) / 255.0); };
    return 0.2126 * channel(16) + 0.7152 * channel(8) + 0.0722 * channel(0);
  };
  for (std::size_t i = 1; i < magma_colours.size(); ++i)
    EXPECT_GT(luminance(magma_colours[i]), luminance(magma_colours[i - 1])) << i;
}

TEST_F(HeatmapFilesTest, are_pictures_of_the_images_size_in_a_folder_made_for_them) {
  const Image reference = busy_image(14, 12);
  Image test = reference;
  test.pixel(5, 6)[0] += 20;
  HeatmapWriter writer(14, 12, folder_ / "new", "cell");
  measure(reference, test, {}, &writer);
  const HeatmapFiles files = writer.finish();
  EXPECT_EQ(files.flip, folder_ / "new" / "cell-flip.png");
  EXPECT_EQ(files.error, folder_ / "new" / "cell-error.png");
  const Image flip = read_image(files.flip.string());
  EXPECT_EQ(flip.width, 14);
  EXPECT_EQ(flip.height, 12);
  const Image error = read_image(files.error.string());
  EXPECT_EQ(error.width, 14);
  // Only the one pixel that differs is not darkest: (20^2/(r^2+.01))/3 is over 100 for r in [0,1].
  EXPECT_NEAR(error.pixel(5, 6)[0], decode_srgb((magma_colours[255] >> 16) / 255.0), 1e-6);
  EXPECT_NEAR(error.pixel(4, 6)[2], decode_srgb((magma_colours[0] & 0xff) / 255.0), 1e-6);
}

TEST_F(HeatmapFilesTest, are_not_there_unless_finished) {
  {
    HeatmapWriter writer(3, 3, folder_, "cell");
    const std::vector<float> zeros(9);
    writer.add(3, zeros.data(), zeros.data());
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(HeatmapFilesTest, refuse_a_folder_that_cannot_be_made) {
  const Image image = busy_image(3, 3);
  write_png((folder_ / "file").string(), image);
  EXPECT_THROW(HeatmapWriter(3, 3, folder_ / "file" / "below", "cell"), InputError);
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
