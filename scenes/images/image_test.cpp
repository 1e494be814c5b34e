#include "scenes/images/image.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_images {
namespace {

namespace fs = std::filesystem;

class image : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }

  /// Everything in the folder, to see that nothing half-written is left behind.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
    return names;
  }
};

void expect_same_bits(const Image& a, const Image& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint32_t>(a.rgb[i]), std::bit_cast<std::uint32_t>(b.rgb[i])) << i;
}

Image ramp(int width, int height, float step) {
  Image result(width, height);
  for (std::size_t i = 0; i < result.rgb.size(); ++i) result.rgb[i] = step * static_cast<float>(i);
  return result;
}

TEST_F(image, exr_keeps_every_bit_also_of_nan_and_infinity) {
  Rendering rendering{ramp(5, 3, 0.1f), std::nullopt, {}};
  rendering.mean.pixel(1, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  rendering.mean.pixel(2, 1)[1] = std::numeric_limits<float>::infinity();
  rendering.mean.pixel(4, 2)[2] = -1e-38f;
  write_exr(path("a.exr"), rendering);
  const Rendering read = read_rendering(path("a.exr"));
  expect_same_bits(read.mean, rendering.mean);
  EXPECT_FALSE(read.variance.has_value());
}

TEST_F(image, exr_keeps_the_variance_layer_and_metadata) {
  const Rendering rendering{ramp(4, 4, 1), ramp(4, 4, 1e-9f), {{"scene", "cornell"}, {"photonproof:seed", "17"}}};
  write_exr(path("a.exr"), rendering);
  const Rendering read = read_rendering(path("a.exr"));
  expect_same_bits(read.mean, rendering.mean);
  ASSERT_TRUE(read.variance.has_value());
  expect_same_bits(*read.variance, *rendering.variance);
  for (const auto& [name, value] : rendering.metadata) {
    ASSERT_TRUE(read.metadata.count(name)) << name;
    EXPECT_EQ(read.metadata.at(name), value);
  }
}

TEST_F(image, exr_of_the_same_rendering_has_the_same_bytes) {
  const Rendering rendering{ramp(8, 8, 0.3f), std::nullopt, {{"scene", "x"}}};
  write_exr(path("a.exr"), rendering);
  write_exr(path("b.exr"), rendering);
  const std::string bytes = read_file(path("a.exr"));
  EXPECT_EQ(bytes, read_file(path("b.exr")));
  // No time of writing: a "YYYY:MM:DD" would start with a year of this century.
  EXPECT_EQ(bytes.find(":20"), std::string::npos);
}

TEST_F(image, png_stores_srgb_codes_and_reads_them_back_as_linear) {
  Image linear(3, 1);
  // 0.5 encodes as 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354, code 187.5 -> 188. The code 188/255 decodes to 0.50289.
  // 0.001 is on the linear part: 12.92 * 0.001 * 255 = 3.29 -> 3. The code 3/255/12.92 = 0.00091057.
  linear.rgb = {0.5f,  0.001f, 1,
                2,     -1,     std::numeric_limits<float>::quiet_NaN(),
                0.25f, 0,      std::numeric_limits<float>::infinity()};
  write_png(path("a.png"), linear);
  const Image read = read_image(path("a.png"));
  ASSERT_EQ(read.width, 3);
  EXPECT_NEAR(read.rgb[0], 0.50289, 1e-5);
  EXPECT_NEAR(read.rgb[1], 0.00091057, 1e-7);
  EXPECT_FLOAT_EQ(read.rgb[2], 1);
  EXPECT_FLOAT_EQ(read.rgb[3], 1);  // clamped
  EXPECT_EQ(read.rgb[4], 0);        // clamped
  EXPECT_EQ(read.rgb[5], 0);        // NaN shows black
  EXPECT_FLOAT_EQ(read.rgb[8], 1);
}

TEST_F(image, png_exposure_counts_in_stops) {
  Image linear(1, 1);
  linear.rgb = {0.25f, 0.125f, 0.5f};
  write_png(path("plus.png"), linear, 2);
  // 2 stops = times 4: 1, 0.5 (code 188, see above), and 2 clamped to 1.
  const Image read = read_image(path("plus.png"));
  EXPECT_FLOAT_EQ(read.rgb[0], 1);
  EXPECT_NEAR(read.rgb[1], 0.50289, 1e-5);
  EXPECT_FLOAT_EQ(read.rgb[2], 1);
}

TEST_F(image, is_replaced_only_by_a_whole_one) {
  write_exr(path("a.exr"), {ramp(2, 2, 1), std::nullopt, {}});
  const std::string before = read_file(path("a.exr"));
  Rendering broken{ramp(2, 2, 1), ramp(3, 3, 1), {}};
  EXPECT_EQ(input_error_of([&] { write_exr(path("a.exr"), broken); }),
            path("a.exr") + ": error: cannot be written: mean and variance differ in size");
  EXPECT_EQ(input_error_of([&] { write_exr(path("a.exr"), {}); }),
            path("a.exr") + ": error: cannot be written: the image has no pixels or too few for its size");
  EXPECT_EQ(read_file(path("a.exr")), before);
  EXPECT_EQ(files(), std::vector<std::string>{"a.exr"});
}

TEST_F(image, cannot_be_written_where_there_is_no_folder) {
  const Rendering rendering{ramp(2, 2, 1), std::nullopt, {}};
  const std::string target = path("missing/a.exr");
  EXPECT_EQ(input_error_of([&] { write_exr(target, rendering); }),
            target + ": error: folder '" + path("missing") + "' does not exist");
  EXPECT_EQ(input_error_of([&] { write_png(folder_.string(), rendering.mean); }),
            folder_.string() + ": error: is a folder, expected a file name");
}

TEST_F(image, cannot_be_written_into_a_folder_that_refuses_files) {
  // No user, not even root, may create a file in /proc.
  if (!fs::is_directory("/proc/self")) GTEST_SKIP() << "no /proc here";
  const Rendering rendering{ramp(2, 2, 1), std::nullopt, {}};
  EXPECT_EQ(
      input_error_of([&] { write_exr("/proc/a.exr", rendering); }).rfind("/proc/a.exr: error: cannot be written: ", 0),
      0u);
  EXPECT_EQ(input_error_of([&] {
              write_png("/proc/a.png", rendering.mean);
            }).rfind("/proc/a.png: error: cannot be written: ", 0),
            0u);
}

TEST_F(image, that_is_truncated_is_refused_at_every_length) {
  write_exr(path("whole.exr"), {ramp(64, 64, 0.37f), std::nullopt, {}});
  const std::string bytes = read_file(path("whole.exr"));
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{3}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    std::ofstream(path("cut.exr"), std::ios::binary) << bytes.substr(0, length);
    EXPECT_THROW(read_rendering(path("cut.exr")), InputError) << length << " of " << bytes.size() << " bytes";
  }
}

TEST_F(image, png_that_is_cut_or_changed_is_refused_without_a_line_of_libpngs_own) {
  write_png(path("whole.png"), ramp(16, 16, 0.37f));
  const std::string bytes = read_file(path("whole.png"));
  const auto said = [&](const std::string& content) {
    std::ofstream(path("bad.png"), std::ios::binary) << content;
    testing::internal::CaptureStderr();
    const std::string message = input_error_of([&] { read_image(path("bad.png")); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return message;
  };
  const std::string damaged = path("bad.png") + ": error: cannot be read, truncated or damaged: ";
  for (const std::size_t length : {std::size_t{20}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_EQ(said(bytes.substr(0, length)), damaged + "it ends before its last chunk") << length;
  // After the 8 bytes of the signature, a header of 8 + 13 + 4: the width's last byte is number 19.
  std::string other = bytes;
  other[19] = static_cast<char>(other[19] ^ 1);
  EXPECT_EQ(said(other), damaged + "IHDR: CRC error");
  // Every byte is the signature's or under a checksum.
  for (std::size_t i = 8; i < bytes.size(); ++i) {
    other = bytes;
    other[i] = static_cast<char>(other[i] ^ 4);
    EXPECT_EQ(said(other).rfind(damaged, 0), 0u) << i << ": " << said(other);
  }
  std::ofstream(path("bad.png"), std::ios::binary) << bytes;
  EXPECT_EQ(read_image(path("bad.png")).width, 16);
}

TEST_F(image, that_claims_more_pixels_than_it_holds_costs_no_memory_for_them) {
  // 16384 x 16384 pixels of three floats would be 3 GB; the file has four pixels.
  std::ofstream(path("claims.pfm"), std::ios::binary) << "PF\n16384 16384\n-1.0\n" << std::string(48, '\0');
  const auto peak_kilobytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  // OpenImageIO's own libraries take some 100 MB.
  std::ofstream(path("small.pfm"), std::ios::binary) << "PF\n1 1\n-1.0\n" << std::string(12, '\0');
  read_image(path("small.pfm"));
  const long before = peak_kilobytes();
  EXPECT_THROW(read_image(path("claims.pfm")), InputError);
  EXPECT_LT(peak_kilobytes() - before, 100'000);
}

TEST_F(image, that_is_missing_or_something_else_is_refused_by_name) {
  EXPECT_EQ(input_error_of([&] { read_image(path("no.exr")); }), path("no.exr") + ": error: no such file");
  EXPECT_EQ(input_error_of([&] { read_image(folder_.string()); }), folder_.string() + ": error: not a regular file");
  std::ofstream(path("text.exr")) << "not an image";
  EXPECT_EQ(input_error_of([&] {
              read_image(path("text.exr"));
            }).rfind(path("text.exr") + ": error: cannot be read as an image: ", 0),
            0u);
}

TEST_F(image, of_one_channel_is_grey) {
  // A Netpbm grey map: 2 x 1 pixels, codes 0 and 255.
  std::ofstream(path("grey.pgm"), std::ios::binary) << "P5\n2 1\n255\n" << std::string("\0\xff", 2);
  const Image read = read_image(path("grey.pgm"));
  EXPECT_EQ(read.rgb, (std::vector<float>{0, 0, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace photonproof::inline scenes_images
