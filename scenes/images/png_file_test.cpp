// PNGs of other programs: palettes, 16 bits, alpha, interlaced, rows out of order.

#include "scenes/images/png_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>

#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_images {
namespace {

class PngFile : public FolderTest {
 protected:
  std::string path() const { return folder_ / "a.png"; }

  /// Rows of bytes as the file has them.
  void write(int width, int depth, int colour_type, const std::vector<std::vector<png_byte>>& rows,
             int interlace = PNG_INTERLACE_NONE) {
    std::FILE* const file = std::fopen(path().c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()), depth, colour_type,
                 interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (colour_type == PNG_COLOR_TYPE_PALETTE) {
      const png_color palette[3] = {{0, 0, 0}, {255, 0, 51}, {102, 255, 0}};
      png_set_PLTE(png, info, palette, 3);
    }
    std::vector<png_bytep> starts;
    for (const auto& row : rows) starts.push_back(const_cast<png_bytep>(row.data()));
    png_write_info(png, info);
    png_write_image(png, starts.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
  }
  std::vector<float> numbers() const { return read_texture_image(path(), true).rgb; }
};

TEST_F(PngFile, palette_of_four_bits_gives_its_colours) {
  write(3, 4, PNG_COLOR_TYPE_PALETTE, {{0x12, 0x00}});  // colours 1, 2, 0
  EXPECT_EQ(numbers(), (std::vector<float>{1, 0, 51 / 255.f, 102 / 255.f, 1, 0, 0, 0, 0}));
}

TEST_F(PngFile, sixteen_bits_have_their_upper_byte_first) {
  write(1, 16, PNG_COLOR_TYPE_RGB, {{0xff, 0xff, 0x01, 0x02, 0x00, 0x01}});
  EXPECT_EQ(numbers(), (std::vector<float>{1, 258 / 65535.f, 1 / 65535.f}));
}

TEST_F(PngFile, alpha_does_not_scale_the_colour) {
  write(2, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {{51, 0, 255, 128}});
  EXPECT_EQ(numbers(), (std::vector<float>{51 / 255.f, 51 / 255.f, 51 / 255.f, 1, 1, 1}));
  write(1, 8, PNG_COLOR_TYPE_RGB_ALPHA, {{51, 102, 255, 1}});
  EXPECT_EQ(numbers(), (std::vector<float>{51 / 255.f, 102 / 255.f, 1}));
}

TEST_F(PngFile, single_bits_are_black_and_white) {
  write(3, 1, PNG_COLOR_TYPE_GRAY, {{0x40}});  // 0 1 0
  EXPECT_EQ(numbers(), (std::vector<float>{0, 0, 0, 1, 1, 1, 0, 0, 0}));
}

TEST_F(PngFile, interlaced_and_plain_rows_are_the_same_in_any_order) {
  std::vector<std::vector<png_byte>> rows(9, std::vector<png_byte>(3 * 7));
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t i = 0; i < rows[y].size(); ++i) rows[y][i] = static_cast<png_byte>(25 * y + i);
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    write(7, 8, PNG_COLOR_TYPE_RGB, rows, interlace);
    const auto file = open_png(path());
    std::vector<float> row(3 * 7);
    for (const int y : {4, 5, 0, 8, 8, 2}) {
      file->read(y, y + 1, 0, 3, row.data());
      for (std::size_t i = 0; i < row.size(); ++i)
        EXPECT_EQ(row[i], static_cast<float>(25 * y + static_cast<int>(i)) / 255) << y << " " << interlace;
    }
  }
}

TEST_F(PngFile, that_does_not_fit_on_the_disk_is_an_error) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const int side : {2, 300}) {  // less and more than what is buffered
    std::vector<std::uint8_t> noise(static_cast<std::size_t>(3 * side * side));
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>(i * i * 2654435761u >> 13);
    EXPECT_EQ(input_error_of([&] {
                const auto png = create_png("/dev/full", "a.png", side, side);
                png->add(side, noise.data());
                png->close();
              }),
              "a.png: error: cannot be written: No space left on device");
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_images
