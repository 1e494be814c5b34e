#include "reports/page/picture.h"

#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_page {
namespace {

namespace fs = std::filesystem;

class Picture : public testing::Test {
 protected:
  Picture() : folder(temporary.path() / "results") {
    fs::create_directory(folder);
    write_sample_pictures(folder);
  }
  EmbeddedPicture picture(const std::string& file) const { return embed_thumbnail(folder, file, 4096); }

  TemporaryFolder temporary;
  const fs::path folder;
};

TEST_F(Picture, a_png_becomes_a_data_uri_with_its_size) {
  const EmbeddedPicture box = picture("box.png");
  EXPECT_EQ(box.problem, "");
  EXPECT_EQ(box.width, 8);
  EXPECT_EQ(box.height, 8);
  // Every PNG starts with the same eight bytes and the length and type of its first chunk.
  EXPECT_EQ(box.uri.rfind("data:image/png;base64,iVBORw0KGgoAAAANSUhEUg", 0), 0u) << box.uri.substr(0, 50);
}

TEST_F(Picture, what_cannot_be_shown_is_said) {
  EXPECT_EQ(picture("").problem, "no picture was made");
  EXPECT_EQ(picture("gone.png").problem, "gone.png is missing");
  std::ofstream(folder / "text.png") << "not a picture";
  EXPECT_EQ(picture("text.png").problem, "text.png is not a PNG");
  fs::create_directory(folder / "sub");
  EXPECT_EQ(picture("sub").problem, "sub cannot be read");
}

TEST_F(Picture, no_file_outside_the_results_folder_is_read) {
  fs::copy_file(folder / "box.png", temporary.path() / "secret.png");
  EXPECT_EQ(picture("../secret.png").problem, "../secret.png lies outside the results folder");
  const std::string absolute = (temporary.path() / "secret.png").string();
  EXPECT_EQ(picture(absolute).problem, absolute + " lies outside the results folder");
  fs::create_symlink(temporary.path() / "secret.png", folder / "link.png");
  EXPECT_EQ(picture("link.png").problem, "link.png lies outside the results folder");
}

TEST_F(Picture, a_size_that_no_page_can_show_is_refused_before_decoding) {
  std::string bytes = file_text(folder / "box.png");
  bytes[16] = '\x7f';  // the first byte of the width: 2130706440 pixels
  std::ofstream(folder / "huge.png", std::ios::binary) << bytes;
  EXPECT_EQ(picture("huge.png").problem, "huge.png is too large to show");
}

TEST_F(Picture, a_thumbnail_is_the_mean_of_whole_blocks) {
  Image image(100, 50);
  for (std::size_t i = 0; i < image.rgb.size(); i += 6) image.rgb[i] = 1;  // every second pixel red
  write_png((folder / "wide.png").string(), image);
  const EmbeddedPicture thumbnail = embed_thumbnail(folder, "wide.png", 64);
  EXPECT_EQ(thumbnail.problem, "");
  EXPECT_EQ(thumbnail.width, 50);  // 2 is the smallest factor that brings 100 below 64
  EXPECT_EQ(thumbnail.height, 25);
  EXPECT_EQ(embed_thumbnail(folder, "wide.png", 100).width, 100);
}

TEST_F(Picture, a_damaged_png_gives_no_thumbnail) {
  Image image(100, 100);
  write_png((folder / "cut.png").string(), image);
  fs::resize_file(folder / "cut.png", 40);
  EXPECT_EQ(embed_thumbnail(folder, "cut.png", 64).problem, "cut.png cannot be decoded");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_page
