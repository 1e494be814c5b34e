#include "reports/page/pixel_data.h"

#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_page {
namespace {

/// Decodes as the page's script does (templates/viewer_pixels.js).
double value_of(int code) {
  const int size = std::abs(code);
  if (size == 0) return 0;
  if (size == 32767) return std::numeric_limits<double>::quiet_NaN();
  const double value = size == 32766 ? std::numeric_limits<double>::infinity() : std::exp2((size - 5121) / 256.0);
  return code < 0 ? -value : value;
}

TEST(PixelData, a_value_comes_back_within_half_a_step) {
  const double half_step = std::exp2(0.5 / 256) - 1;  // 0.14 %
  for (double value = 0x1p-20; value < 0x1p28; value *= 1.0317) {
    for (const double sign : {1.0, -1.0}) {
      const double back = value_of(pixel_code(static_cast<float>(sign * value)));
      EXPECT_NEAR(back / (sign * value), 1, half_step * 1.001) << value;
    }
  }
}

TEST(PixelData, what_has_no_logarithm_or_is_out_of_range_has_a_code) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(pixel_code(0), 0);
  EXPECT_EQ(pixel_code(1e-20f), 0);
  EXPECT_EQ(value_of(pixel_code(1e30f)), 0x1p28);
  EXPECT_TRUE(std::isnan(value_of(pixel_code(std::numeric_limits<float>::quiet_NaN()))));
  EXPECT_EQ(value_of(pixel_code(infinity)), infinity);
  EXPECT_EQ(value_of(pixel_code(-infinity)), -infinity);
}

std::string inflated(const std::string& bytes, std::size_t size) {
  std::string out(size, '\0');
  uLongf length = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()),
            Z_OK);
  EXPECT_EQ(length, size);
  return out;
}

TEST(PixelData, planes_unfold_to_the_codes_of_every_channel) {
  Image image(37, 11);
  std::uint32_t state = 1;
  for (float& value : image.rgb) {
    state = state * 1664525u + 1013904223u;
    value = std::exp2(static_cast<float>(state >> 20) / 128 - 12);
  }
  image.pixel(5, 5)[1] = std::numeric_limits<float>::quiet_NaN();
  image.pixel(6, 5)[0] = -3;
  image.pixel(7, 5)[2] = 0;
  const std::size_t n = image.pixels();
  const std::string planes = inflated(packed_pixels(image), 6 * n);
  const auto byte = [&](std::size_t at) { return static_cast<int>(static_cast<unsigned char>(planes[at])); };
  int left[3] = {0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int folded = byte(2 * k * n + i) | byte((2 * k + 1) * n + i) << 8;
      left[k] += folded % 2 ? -(folded + 1) / 2 : folded / 2;
    }
    EXPECT_EQ(static_cast<std::int16_t>(left[0] + left[1]), pixel_code(image.rgb[3 * i]));
    EXPECT_EQ(static_cast<std::int16_t>(left[0]), pixel_code(image.rgb[3 * i + 1]));
    EXPECT_EQ(static_cast<std::int16_t>(left[0] + left[2]), pixel_code(image.rgb[3 * i + 2]));
  }
}

class PixelDataOfFolder : public testing::Test {
 protected:
  PixelDataOfFolder() {
    Image image(64, 64);
    std::uint32_t state = 1;
    for (float& value : image.rgb) {
      state = state * 1664525u + 1013904223u;
      value = static_cast<float>(state >> 8) / 0x1p24f;
    }
    write_exr((folder.path() / "a.exr").string(), {image, std::nullopt, {}});
    write_png((folder.path() / "a.png").string(), image, 1);
  }
  TemporaryFolder folder;
};

TEST_F(PixelDataOfFolder, images_are_reduced_until_they_fit) {
  const PixelDataSet whole = pixel_data(folder.path(), {{"a.exr", "a.png"}}, 0, 1 << 20);
  EXPECT_EQ(whole.reduced_by, 1);
  EXPECT_FALSE(whole.images[0].from_picture);
  // A quarter of the pixels take about a quarter of the bytes, so a limit of a third allows a factor of 2.
  const std::size_t third = whole.images[0].base64.size() / 3;
  const PixelDataSet half = pixel_data(folder.path(), {{"a.exr", "a.png"}}, 0, third);
  EXPECT_EQ(half.reduced_by, 2);
  EXPECT_LE(half.images[0].base64.size(), third);
  EXPECT_EQ(half.images[0].width, 64);  // the size of the render, not of the reduced copy
}

// The picture is no FLIP map, although it has the image's size. The map of another size is not shown.
TEST_F(PixelDataOfFolder, flip_maps_come_along_and_count) {
  for (const int side : {64, 32}) {
    PngRows flip((folder.path() / ("flip" + std::to_string(side) + ".png")).string(), side, side);
    std::vector<std::uint8_t> black(3 * 64 * 64);
    for (std::size_t i = 0; i < black.size(); i += 3) black[i + 2] = 4;  // magma's 0x000004
    flip.add(side, black.data());
    flip.finish();
  }
  const PixelDataSet set = pixel_data(
      folder.path(), {{"a.exr", "", "flip64.png"}, {"a.exr", "", "flip32.png"}, {"a.exr", "", "a.png"}, {"a.exr", ""}},
      0, 1 << 20);
  EXPECT_NE(set.images[0].flip_base64, "");
  for (const std::size_t i : {1, 2, 3}) EXPECT_EQ(set.images[i].flip_base64, "") << i;
  const std::size_t needed = set.images[3].base64.size() + set.images[0].flip_base64.size();
  EXPECT_EQ(pixel_data(folder.path(), {{"a.exr", "", "flip64.png"}}, 0, needed).reduced_by, 1);
  EXPECT_EQ(pixel_data(folder.path(), {{"a.exr", "", "flip64.png"}}, 0, needed - 1).reduced_by, 2);
}

TEST_F(PixelDataOfFolder, without_the_exr_the_picture_serves) {
  const PixelDataSet set = pixel_data(folder.path(), {{"", "a.png"}, {"none.exr", ""}, {"../a.exr", ""}}, 1, 1 << 20);
  EXPECT_TRUE(set.images[0].from_picture);
  EXPECT_EQ(set.images[1].problem, "none.exr is missing");
  EXPECT_EQ(set.images[1].base64, "");
  EXPECT_EQ(set.images[2].base64, "");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_page
