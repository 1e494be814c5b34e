// One picture in every format that submissions may write, and files that are no images.
#include "harness/submissions/submitted_image.h"

#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "harness/sandbox/sandbox.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_submissions {
namespace {

using namespace std::string_literals;

class SubmittedImageTest : public FolderTest {
 protected:
  void SetUp() override {
    if (const auto why = why_no_sandbox()) GTEST_SKIP() << *why;
    FolderTest::SetUp();
    declaration_ = {.width = 2, .height = 2};
  }
  SubmittedImage read(SubmittedFormat format, const std::string& bytes) {
    put("file", bytes);
    declaration_.format = format;
    return read_submitted_image(folder_ / "file", "out", declaration_, PHOTONPROOF_BINARY);
  }
  std::string wrong(SubmittedFormat format, const std::string& bytes) { return read(format, bytes).wrong; }
  // Red and green above blue and white, up to the format's precision.
  void expect_picture(const SubmittedImage& read, double tolerance = 1e-6) const {
    ASSERT_TRUE(read.image) << read.wrong;
    const std::vector<float> expected{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(read.image->rgb[i], expected[i], tolerance) << i;
  }
  ImageDeclaration declaration_;
};

std::string floats(std::initializer_list<float> values) {
  std::string bytes(4 * values.size(), '\0');
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

// BMP of 24 bits: lowest row first, rows padded to 4 bytes, blue before green before red.
const std::string bmp =
    "BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\x02\0\0\0\x01\0\x18\0\0\0\0\0\x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"
    "\0\0\0\0"
    "\xff\0\0\xff\xff\xff\0\0\0\0\xff\0\xff\0\0\0"s;
// Uncompressed, 24 bits, lowest row first.
const std::string tga = "\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0\xff\0\0\xff\xff\xff\0\0\xff\0\xff\0"s;

TEST_F(SubmittedImageTest, every_format_has_its_picture) {
  using enum SubmittedFormat;
  expect_picture(read(ppm, "P3\n2 2\n255\n255 0 0  0 255 0\n0 0 255  255 255 255\n"));
  expect_picture(read(ppm, "P6\n2 2\n255\n\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff"s));
  expect_picture(
      read(ppm, "P6\n2 2\n65535\n\xff\xff\0\0\0\0\0\0\xff\xff\0\0\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff"s));
  expect_picture(read(bmp, photonproof::bmp));
  expect_picture(read(tga, photonproof::tga));
  // The lowest row first, by the format; a negative scale is little-endian.
  expect_picture(read(pfm, "PF\n2 2\n-1.0\n" + floats({0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0})));
  // 128 + 1 is the exponent of 1 when the mantissa is half of 256.
  expect_picture(
      read(hdr,
           "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n\x80\0\0\x81\0\x80\0\x81\0\0\x80\x81\x80\x80\x80\x81"s),
      0.01);
}

// OpenImageIO reads all BMP files that are not plain: both readers must agree, also on the order of rows.
TEST_F(SubmittedImageTest, every_kind_of_bmp_has_the_same_picture) {
  using enum SubmittedFormat;
  const auto header = [](int height, int bits, int bytes) {
    std::string text = photonproof::bmp.substr(0, 54);
    text[2] = static_cast<char>(54 + bytes);
    for (int i = 0; i < 4; ++i) text[static_cast<std::size_t>(22 + i)] = static_cast<char>(height >> (8 * i));
    text[28] = static_cast<char>(bits);
    text[34] = static_cast<char>(bytes);
    return text;
  };
  expect_picture(read(bmp, header(-2, 24, 16) + "\0\0\xff\0\xff\0\0\0\xff\0\0\xff\xff\xff\0\0"s));  // top row first
  expect_picture(read(bmp, header(2, 32, 16) + "\xff\0\0\xff\xff\xff\xff\xff\0\0\xff\xff\0\xff\0\xff"s));
  expect_picture(read(bmp, photonproof::bmp.substr(0, 68)));  // the last row without its padding
  EXPECT_EQ(wrong(bmp, photonproof::bmp.substr(0, 67)), "out is truncated: fewer pixels than its size says");
  EXPECT_EQ(wrong(bmp, header(0, 24, 16) + photonproof::bmp.substr(54)), "out is damaged: a size of 2 x 0");
  std::string far = photonproof::bmp;
  far[10] = far[11] = far[12] = far[13] = '\xff';
  EXPECT_EQ(wrong(bmp, far), "out is truncated: fewer pixels than its size says");
  far[10] = '\0', far[11] = far[12] = far[13] = '\0';
  EXPECT_NE(wrong(bmp, far), "");
}

TEST_F(SubmittedImageTest, numbers_of_ppm_and_pfm_are_exact) {
  using enum SubmittedFormat;
  const auto number = [this](SubmittedFormat format, const std::string& bytes) {
    const SubmittedImage image = read(format, bytes);
    EXPECT_EQ(image.wrong, "");
    return image.image ? image.image->rgb[0] : -1;
  };
  declaration_.width = declaration_.height = 1;
  EXPECT_EQ(number(ppm, "P6 1 1 65535\n\xff\xfe\0\0\0\0"s), 65534.0f / 65535.0f);
  EXPECT_EQ(number(ppm, "P6 1 1 100\n\x19\0\0"s), 0.25f);
  EXPECT_EQ(number(ppm, "P3 # a comment\n1 #another\n1\n1000 # 250 0 0\n250 7 7"), 0.25f);
  EXPECT_EQ(number(pfm, "PF\n1 1\n1\n\x3e\x80\0\0\0\0\0\0\0\0\0\0"s), 0.25f);  // big-endian: 0x3e800000
  EXPECT_EQ(number(pfm, "Pf\n1 1\n-1\n" + floats({-0.25f})), -0.25f);
  EXPECT_EQ(wrong(ppm, "P6 1 1 100\n\x65\0\0"s), "out is damaged: a number above its greatest value");
  EXPECT_EQ(wrong(ppm, "P3 1 1 255 1 2"), "out is truncated: fewer numbers than its size says");
  EXPECT_EQ(wrong(ppm, "P3 1 1 255 1 2 x"), "out is damaged: expected a number up to 255");
  EXPECT_EQ(wrong(ppm, "P6 1 99999999999 255\n"), "out is damaged: expected a number up to 16777216");
}

TEST_F(SubmittedImageTest, exr_and_png_are_read_too) {
  Rendering rendering;
  rendering.mean = Image(2, 2);
  rendering.mean.rgb = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  write_exr((folder_ / "a.exr").string(), rendering);
  write_png((folder_ / "a.png").string(), rendering.mean);
  expect_picture(read(SubmittedFormat::exr, get("a.exr")));
  expect_picture(read(SubmittedFormat::png, get("a.png")));
}

TEST_F(SubmittedImageTest, declaration_is_undone) {
  // 0.2 is below sRGB's curve at ((0.2 + 0.055) / 1.055)^2.4 = 0.0331; 0.2^2.2 = 0.02899
  const std::string text = "P3 2 2 255  255 0 0  0 255 0  0 0 255  51 51 51\n";
  declaration_.transfer.kind = Transfer::Kind::srgb;
  EXPECT_NEAR(read(SubmittedFormat::ppm, text).image->rgb[9], 0.0331, 1e-4);
  declaration_.transfer = {Transfer::Kind::gamma, 2.2};
  EXPECT_NEAR(read(SubmittedFormat::ppm, text).image->rgb[9], 0.02899, 1e-5);
  declaration_.transfer = {};
  declaration_.scale = 4;
  declaration_.bottom_up = true;
  const SubmittedImage turned = read(SubmittedFormat::ppm, text);
  const std::vector<float> expected{0, 0, 0.25f, 0.05f, 0.05f, 0.05f, 0.25f, 0, 0, 0, 0.25f, 0};
  EXPECT_THAT(turned.image->rgb, testing::Pointwise(testing::FloatNear(1e-6f), expected));
}

TEST_F(SubmittedImageTest, what_is_wrong_is_a_sentence) {
  using enum SubmittedFormat;
  EXPECT_EQ(wrong(bmp, ""), "out is empty");
  EXPECT_EQ(wrong(bmp, "hello, hello, hello"), "out is no BMP file");
  EXPECT_EQ(wrong(bmp, "P6\n2 2\n255\n"), "out is a PPM file, not BMP");
  EXPECT_EQ(wrong(ppm, photonproof::bmp), "out is a BMP file, not PPM");
  EXPECT_EQ(wrong(tga, photonproof::bmp), "out is a BMP file, not TGA");
  EXPECT_EQ(wrong(ppm, "P6\n3 2\n255\n"), "out is 3x2, not 2x2");
  EXPECT_EQ(wrong(ppm, "P6\n100000 100000\n255\n"), "out is 100000x100000, not 2x2");
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(wrong(pfm, "PF\n2 2\n-1.0\n" + floats({0, 0, nan, 1, 1, 1, 1, 0, 0, 0, 1, 0})),
            "out has a pixel that is not finite (NaN or infinite), (0, 1)");
  EXPECT_EQ(wrong(pfm, "PF\n2 2\n-1.0\n" + floats({0, 0, nan, 1, 1, 1, 1, 0, 0, 0, infinite, 0})),
            "out has 2 pixels that are not finite (NaN or infinite), the first is (1, 0)");
}

TEST_F(SubmittedImageTest, truncated_files_are_told_from_whole_ones) {
  using enum SubmittedFormat;
  Rendering rendering;
  rendering.mean = Image(2, 2);
  write_exr((folder_ / "a.exr").string(), rendering);
  write_png((folder_ / "a.png").string(), rendering.mean);
  const std::string exr_bytes = get("a.exr"), png_bytes = get("a.png");
  for (const auto& [format, bytes] : std::initializer_list<std::pair<SubmittedFormat, std::string>>{
           {exr, exr_bytes},
           {png, png_bytes},
           {bmp, photonproof::bmp},
           {tga, photonproof::tga},
           {ppm, "P6\n2 2\n255\n\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff"s},
           {pfm, "PF\n2 2\n-1.0\n" + floats({0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0})}}) {
    EXPECT_NE(wrong(format, bytes.substr(0, bytes.size() - 7)), "") << name_of(format);
    EXPECT_NE(wrong(format, bytes.substr(0, 20)), "") << name_of(format);
  }
}

TEST_F(SubmittedImageTest, only_regular_files_are_opened) {
  declaration_.format = SubmittedFormat::bmp;
  const auto read_at = [this](const char* name) {
    return read_submitted_image(folder_ / name, "out", declaration_, PHOTONPROOF_BINARY).wrong;
  };
  std::filesystem::create_symlink("/etc/passwd", folder_ / "link");
  mkfifo((folder_ / "pipe").c_str(), 0666);
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_EQ(read_at("link"), "out is a symbolic link, not a file");
  EXPECT_EQ(read_at("pipe"), "out is no regular file");
  EXPECT_EQ(read_at("folder"), "out is no regular file");
  EXPECT_EQ(read_at("none"), "out was not written");
}

}  // namespace
}  // namespace photonproof::inline harness_submissions
