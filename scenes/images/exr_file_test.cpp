// EXRs of other programs: tiles, windows, layers, grey; and damaged ones.

#include "scenes/images/exr_file.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_images {
namespace {

class ExrFile : public FolderTest {
 protected:
  std::string path() const { return folder_ / "a.exr"; }

  /// One float channel a name, all with the values 0, 1, 2, ... plus 1000 times the channel's number.
  Imf::FrameBuffer channels(Imf::Header& header, const std::vector<std::string>& names) {
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    Imf::FrameBuffer buffer;
    values_.assign(names.size(), std::vector<float>(static_cast<std::size_t>(width * height)));
    for (std::size_t c = 0; c < names.size(); ++c) {
      for (std::size_t i = 0; i < values_[c].size(); ++i) values_[c][i] = static_cast<float>(1000 * c + i);
      header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
      buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, values_[c].data(), window));
    }
    return buffer;
  }
  void write_lines(const std::vector<std::string>& names, int width = 4, int height = 3) {
    Imf::Header header(width, height);
    const Imf::FrameBuffer buffer = channels(header, names);
    Imf::OutputFile out(path().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(height);
  }
  std::string refusal() const {
    return input_error_of([&] { read_image(path()); });
  }

  std::vector<std::vector<float>> values_;
};

TEST_F(ExrFile, that_claims_gigabytes_for_an_attribute_is_refused_before_they_are_allocated) {
  write_lines({"R", "G", "B"});
  std::ifstream in(path(), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string attribute("compression\0compression\0", 24);
  const std::size_t at = bytes.find(attribute) + attribute.size();
  bytes.replace(at, 4, "\xff\xff\xff\x7f");
  std::ofstream(path(), std::ios::binary) << bytes;
  EXPECT_EQ(refusal(), path() +
                           ": error: cannot be read as an image: attribute 'compression' claims 2147483647 bytes, " +
                           std::to_string(bytes.size() - at - 4) + " are left");
}

TEST_F(ExrFile, in_tiles_with_a_window_off_the_origin_is_read_as_any_other) {
  const int width = 70, height = 50;
  const Imath::Box2i window({-7, 11}, {-7 + width - 1, 11 + height - 1});
  Imf::Header header(window, window);
  header.setTileDescription({32, 16, Imf::ONE_LEVEL});
  const Imf::FrameBuffer buffer = channels(header, {"B", "G", "R"});
  {
    Imf::TiledOutputFile out(path().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
  }
  const Image image = read_image(path());
  ASSERT_EQ(image.width, width);
  ASSERT_EQ(image.height, height);
  for (const auto& [x, y] : {std::pair{0, 0}, {69, 0}, {31, 17}, {32, 16}, {69, 49}}) {
    const auto i = static_cast<float>(y * width + x);
    EXPECT_EQ(image.pixel(x, y)[0], 2000 + i);
    EXPECT_EQ(image.pixel(x, y)[1], 1000 + i);
    EXPECT_EQ(image.pixel(x, y)[2], i);
  }
}

TEST_F(ExrFile, colour_is_the_plain_one_then_a_layers_then_grey) {
  // Pixel 1: each channel's value is 1000 times its place in the list, plus 1.
  write_lines({"A", "B", "G", "R", "a.B", "a.G", "a.R"});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[0], 3001);
  write_lines({"Z", "beauty.A", "beauty.B", "beauty.G", "beauty.R"});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[0], 4001);
  EXPECT_EQ(read_image(path()).pixel(1, 0)[2], 2001);
  write_lines({"A", "Y"});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[2], 1001);
  write_lines({"depth"});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[1], 1);
  for (const auto& names : {std::vector<std::string>{"A"}, {"Z"}, {"u", "v"}, {"BY", "RY", "Y"}}) {
    write_lines(names);
    EXPECT_EQ(refusal(), path() + ": error: image has no colour: expected channels R, G, B or a single grey one");
  }
}

const std::vector<std::string> ao_and_combined = {
    "ViewLayer.AO.B",       "ViewLayer.AO.G",       "ViewLayer.AO.R",       "ViewLayer.Combined.A",
    "ViewLayer.Combined.B", "ViewLayer.Combined.G", "ViewLayer.Combined.R", "ViewLayer.Depth.Z"};

// As Blender writes its passes. Red of pixel 1 is 2001 in AO, the first by the alphabet, and 6001 in Combined.
TEST_F(ExrFile, of_several_layers_gives_the_combined_one_and_says_so) {
  write_lines(ao_and_combined);
  EXPECT_EQ(read_image(path()).pixel(1, 0)[0], 6001);
  EXPECT_EQ(read_image(path()).pixel(1, 0)[2], 4001);
  EXPECT_EQ(ImageRows(path()).remarks(), std::vector<std::string>{"layer ViewLayer.Combined"});
  write_lines({"R", "G", "B", "A"});
  EXPECT_EQ(ImageRows(path()).remarks(), std::vector<std::string>{});
}

TEST_F(ExrFile, gives_the_layer_that_is_asked_for) {
  write_lines(ao_and_combined);
  EXPECT_EQ(read_rendering(path(), "ViewLayer.AO").mean.pixel(1, 0)[0], 2001);
  EXPECT_EQ(read_rendering(path(), "AO").mean.pixel(1, 0)[0], 2001);
  EXPECT_EQ(read_rendering(path(), "ViewLayer.Depth.Z").mean.pixel(1, 0)[1], 7001);
  EXPECT_EQ(ImageRows(path(), "ViewLayer.Depth.Z").remarks(),
            std::vector<std::string>{"grey from channel ViewLayer.Depth.Z"});
  EXPECT_EQ(input_error_of([&] { read_rendering(path(), "Diffuse"); }),
            path() + ": error: has no layer 'Diffuse': it has ViewLayer.AO, ViewLayer.Combined");
}

TEST_F(ExrFile, of_several_layers_without_a_combined_one_is_refused_with_their_names) {
  write_lines({"a.AO.B", "a.AO.G", "a.AO.R", "a.Diffuse.B", "a.Diffuse.G", "a.Diffuse.R"});
  EXPECT_EQ(refusal(), path() +
                           ": error: holds several images, and none of them alone is called Combined, beauty or rgba: "
                           "a.AO, a.Diffuse; compare --layer NAME takes one");
  write_lines({"a.Combined.B", "a.Combined.G", "a.Combined.R", "b.Combined.B", "b.Combined.G", "b.Combined.R"});
  EXPECT_NE(refusal().find("a.Combined, b.Combined"), std::string::npos) << refusal();
}

// Variances beside a layer may belong to another layer.
TEST_F(ExrFile, of_a_named_layer_has_no_variance) {
  write_lines({"a.B", "a.G", "a.R", "variance.B", "variance.G", "variance.R"});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[0], 2001);
  EXPECT_FALSE(read_rendering(path()).variance);
}

/// A file of several parts, each with the channels R, G, B or one other; all pixels of part p have the value p + 1.
void write_parts(const std::string& path, const std::vector<std::pair<std::string, bool>>& names_and_colour) {
  std::vector<Imf::Header> headers;
  for (const auto& [name, is_colour] : names_and_colour) {
    Imf::Header header(4, 3);
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    for (const char* channel : {"R", "G", "B"})
      if (is_colour) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    if (!is_colour) header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    headers.push_back(header);
  }
  Imf::MultiPartOutputFile out(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t p = 0; p < headers.size(); ++p) {
    const std::vector<float> values(12, static_cast<float>(p + 1));
    Imf::FrameBuffer buffer;
    for (auto channel = headers[p].channels().begin(); channel != headers[p].channels().end(); ++channel)
      buffer.insert(channel.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), headers[p].dataWindow()));
    Imf::OutputPart part(out, static_cast<int>(p));
    part.setFrameBuffer(buffer);
    part.writePixels(3);
  }
}

TEST_F(ExrFile, of_several_parts_is_read_where_its_colour_is) {
  write_parts(path(), {{"depth", false}, {"albedo", true}, {"Combined", true}});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[0], 3);
  EXPECT_EQ(ImageRows(path()).remarks(), std::vector<std::string>{"layer Combined, part 3 of 3"});
  EXPECT_EQ(read_rendering(path(), "albedo").mean.pixel(1, 0)[0], 2);
  EXPECT_EQ(read_rendering(path(), "depth.Z").mean.pixel(1, 0)[0], 1);
  write_parts(path(), {{"depth", false}, {"albedo", true}});
  EXPECT_EQ(read_image(path()).pixel(1, 0)[0], 2);
  write_parts(path(), {{"albedo", true}, {"normals", true}});
  EXPECT_NE(refusal().find(": albedo, normals; compare --layer NAME takes one"), std::string::npos) << refusal();
}

// Numbers of objects, as renderers write them beside the colour.
TEST_F(ExrFile, with_whole_numbers_beside_its_colour_is_read) {
  Imf::Header header(1, 1);
  const std::uint32_t id = 7;
  const float value = 0.25f;
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, &value, header.dataWindow()));
  }
  header.channels().insert("id", Imf::Channel(Imf::UINT));
  buffer.insert("id", Imf::Slice::Make(Imf::UINT, &id, header.dataWindow()));
  {
    Imf::OutputFile out(path().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  }
  EXPECT_EQ(read_image(path()).pixel(0, 0)[1], 0.25f);
}

TEST_F(ExrFile, whose_data_window_is_a_part_of_its_display_window_says_so) {
  Imf::Header header(Imath::Box2i({0, 0}, {7, 5}), Imath::Box2i({2, 1}, {5, 3}));
  const Imf::FrameBuffer buffer = channels(header, {"B", "G", "R"});
  {
    Imf::OutputFile out(path().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(3);
  }
  EXPECT_EQ(ImageRows(path()).remarks(),
            std::vector<std::string>{"stored are 4x3 pixels from (2, 1) on, black around them"});
}

TEST_F(ExrFile, of_whole_numbers_is_refused) {
  Imf::Header header(1, 1);
  const std::uint32_t value = 7;
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::UINT));
    buffer.insert(name, Imf::Slice::Make(Imf::UINT, &value, header.dataWindow()));
  }
  {
    Imf::OutputFile out(path().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  }
  EXPECT_EQ(refusal(), path() + ": error: samples are uint, expected float or 8- or 16-bit");
}

TEST_F(ExrFile, half_colour_is_rounded_to_the_nearest) {
  Rendering rendering{Image(1, 1), Image(1, 1), {}};
  // Halves at 1 are 2^-10 apart: 1 + 0.4 of that is 1, 1 + 0.6 of it the next. The variance stays a float.
  rendering.mean.rgb = {1 + 0.4f / 1024, 1 + 0.6f / 1024, 65504};
  rendering.variance->rgb = {1e-12f, 2e-12f, 1 + 0.4f / 1024};
  write_exr(path(), rendering, ExrColour::half);
  const Rendering read = read_rendering(path());
  EXPECT_EQ(read.mean.rgb, (std::vector<float>{1, 1 + 1.0f / 1024, 65504}));
  EXPECT_EQ(read.variance->rgb, rendering.variance->rgb);
}

TEST_F(ExrFile, that_claims_more_than_it_holds_costs_no_memory_for_it) {
  write_lines({"B", "G", "R"});
  const std::string bytes = read_file(path());
  const std::size_t at = bytes.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
  const auto claim = [&](std::int32_t width, std::int32_t height) {
    std::string other = bytes;
    const std::int32_t box[4] = {0, 0, width - 1, height - 1};
    std::memcpy(other.data() + at, box, sizeof box);
    std::ofstream(path(), std::ios::binary) << other;
  };
  const auto peak_kilobytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak_kilobytes();
  claim(16384, 16384);  // 3 GB of floats
  EXPECT_NE(refusal().find(": error: cannot be read"), std::string::npos) << refusal();
  claim(1 << 30, 1 << 30);
  EXPECT_NE(refusal().find(": error: cannot be read as an image: "), std::string::npos) << refusal();
  EXPECT_LT(peak_kilobytes() - before, 100'000);
}

TEST_F(ExrFile, with_any_byte_changed_is_read_or_refused) {
  write_lines({"B", "G", "R"}, 16, 16);
  const std::string bytes = read_file(path());
  std::mt19937 random(1);
  for (int round = 0; round < 1000; ++round) {
    std::string other = bytes;
    // Mostly in the header, where sizes and types are.
    const std::size_t reach = round % 4 ? 330 : other.size();
    for (int i = 0; i <= round % 3; ++i) other[random() % reach] = static_cast<char>(random());
    std::ofstream(path(), std::ios::binary) << other;
    try {
      read_rendering(path());
    } catch (const InputError&) {
    }
  }
}

TEST_F(ExrFile, that_does_not_fit_on_the_disk_is_an_error) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const int side : {2, 300})  // less and more than what is buffered
    EXPECT_EQ(input_error_of([&] {
                write_exr_file("/dev/full", "a.exr", {Image(side, side), std::nullopt, {}}, ExrColour::single);
              }),
              "a.exr: error: cannot be written: No space left on device");
}

TEST_F(ExrFile, part_of_an_image_is_written_with_its_place_and_alpha_beside_its_colour) {
  Rendering part;
  part.mean = Image(2, 1);
  part.mean.rgb = {1, 2, 3, 4, 5, 6};
  part.variance = part.mean;
  part.alpha = {0.25f, 1};
  part.place = ImagePlace{1, 2, 4, 3};
  write_exr(path(), part);
  const Rendering stored = read_rendering(path(), "", ImageWindow::stored), whole = read_rendering(path());
  EXPECT_EQ(stored.mean.rgb, part.mean.rgb);
  EXPECT_EQ(stored.place, part.place);
  ASSERT_EQ(whole.mean.width, 4);
  ASSERT_EQ(whole.mean.height, 3);
  EXPECT_FALSE(whole.place);
  EXPECT_EQ(whole.mean.pixel(2, 2)[0], 4);
  EXPECT_EQ(whole.variance->pixel(1, 2)[2], 3);
  EXPECT_EQ(whole.mean.pixel(0, 2)[0], 0);
  EXPECT_EQ(displayed(stored).mean.rgb, whole.mean.rgb);
  EXPECT_EQ(displayed(stored).variance->rgb, whole.variance->rgb);

  // The library alone reads both windows, and A.
  Imf::InputFile file(path().c_str());
  EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({1, 2}, {2, 2}));
  EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {3, 2}));
  std::vector<float> alpha(2);
  Imf::FrameBuffer buffer;
  buffer.insert("A", Imf::Slice::Make(Imf::FLOAT, alpha.data(), file.header().dataWindow()));
  file.setFrameBuffer(buffer);
  file.readPixels(2);
  EXPECT_EQ(alpha, part.alpha);
}

// A data window of 2x2 pixels at (1, 1) of a display window of 4x3 whose corner is (10, 20). The same pixels are also
// compared as an image of their own and shifted by one.
TEST_F(ExrFile, data_window_is_read_at_its_place_in_the_display_window) {
  const auto write_at = [&](int x, int y, bool tiled) {
    Imf::Header header(Imath::Box2i({10, 20}, {13, 22}), Imath::Box2i({10 + x, 20 + y}, {11 + x, 21 + y}));
    if (tiled) header.setTileDescription({2, 2, Imf::ONE_LEVEL});
    const Imf::FrameBuffer buffer = channels(header, {"R", "G", "B"});
    if (tiled) {
      Imf::TiledOutputFile out(path().c_str(), header);
      out.setFrameBuffer(buffer);
      out.writeTiles(0, 0, 0, 0);
    } else {
      Imf::OutputFile out(path().c_str(), header);
      out.setFrameBuffer(buffer);
      out.writePixels(2);
    }
  };
  const auto reds = [](const Image& image) {
    std::vector<float> values;
    for (std::size_t i = 0; i < image.pixels(); ++i) values.push_back(image.rgb[3 * i]);
    return values;
  };
  for (const bool tiled : {false, true}) {
    write_at(1, 1, tiled);
    const Image image = read_image(path());
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 3);
    EXPECT_EQ(reds(image), (std::vector<float>{0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 3, 0}));
    EXPECT_EQ(image.pixel(2, 2)[1], 1003);
    std::vector<float> row(3 * 4);
    ImageRows(path()).read(2, 3, row.data());
    EXPECT_EQ(row[3 * 2], 3);
    EXPECT_EQ(read_texture_image(path(), true).width, 2);
    write_at(3, -1, tiled);  // only its lower left pixel inside
    EXPECT_EQ(reds(read_image(path())), (std::vector<float>{0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0}));
    write_at(4, 0, tiled);
    EXPECT_EQ(refusal(), path() + ": error: no pixel of its data window lies in its display window");
  }
}

TEST_F(ExrFile, pointer_of_git_lfs_is_named_as_one) {
  put("a.exr", "version https://git-lfs.github.com/spec/v1\noid sha256:0123\nsize 12345\n");
  EXPECT_EQ(refusal(), path() + ": error: is a pointer of Git LFS, not the file itself: fetch it with git lfs pull");
}

}  // namespace
}  // namespace photonproof::inline scenes_images
