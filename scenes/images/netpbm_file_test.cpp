// Our reader of PFM against OpenImageIO's, which shares no code with it.

#include "scenes/images/netpbm_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <random>

#include "scenes/base/input_error.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_images {
namespace {

using NetpbmFile = FolderTest;

/// Finite numbers of any bits, in the byte order that the sign of the scale means.
std::string pfm(const std::string& kind, const std::string& scale, int width, int height) {
  std::mt19937 random(5);
  std::string file = kind + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + scale + "\n";
  for (int i = 0; i < width * height * (kind == "PF" ? 3 : 1); ++i) {
    const auto value = static_cast<float>(static_cast<double>(random()) / 1e9 - 2);
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    const bool is_little = std::endian::native == std::endian::little;
    if (is_little != scale.starts_with('-')) std::ranges::reverse(bytes);
    file.append(bytes, sizeof bytes);
  }
  return file;
}

std::vector<float> all_rows(ImageFile& file) {
  const int channels = static_cast<int>(file.header().channels.size());
  std::vector<float> values(static_cast<std::size_t>(channels * file.header().width * file.header().height));
  file.read(0, file.header().height, 0, channels, values.data());
  return values;
}

TEST_F(NetpbmFile, plain_pfm_is_what_openimageio_reads) {
  for (const char* kind : {"PF", "Pf"})
    for (const char* scale : {"-1.0", "1.0"}) {
      put("a.pfm", pfm(kind, scale, 5, 3));
      const auto ours = open_plain_pfm(folder_ / "a.pfm"), theirs = open_other_format(folder_ / "a.pfm");
      ASSERT_TRUE(ours) << kind << " " << scale;
      EXPECT_EQ(ours->header().width, 5);
      EXPECT_EQ(ours->header().height, 3);
      EXPECT_EQ(ours->header().channels, theirs->header().channels);
      EXPECT_EQ(ours->header().display_width, theirs->header().display_width);
      EXPECT_EQ(ours->header().display_height, theirs->header().display_height);
      EXPECT_EQ(ours->header().samples, theirs->header().samples);
      EXPECT_EQ(ours->header().remarks, theirs->header().remarks);
      EXPECT_EQ(all_rows(*ours), all_rows(*theirs)) << kind << " " << scale;
    }
}

TEST_F(NetpbmFile, other_files_and_scales_are_left_to_openimageio) {
  put("a.ppm", "P6 1 1 255\nabc");
  put("scaled.pfm", pfm("PF", "-2.5", 2, 2));
  for (const char* name : {"a.ppm", "scaled.pfm", "none.pfm"}) EXPECT_FALSE(open_plain_pfm(folder_ / name)) << name;
  EXPECT_EQ(read_image((folder_ / "scaled.pfm").string()).width, 2);
}

TEST_F(NetpbmFile, pfm_that_is_cut_or_changed_is_read_or_refused) {
  const std::string whole = pfm("PF", "-1.0", 4, 4);
  for (std::size_t length = 2; length < whole.size(); ++length) {
    put("cut.pfm", whole.substr(0, length));
    EXPECT_THROW(open_plain_pfm(folder_ / "cut.pfm"), InputError) << length;
  }
  for (std::size_t at = 2; at < 14; ++at)
    for (int byte = 0; byte < 256; ++byte) {
      std::string other = whole;
      other[at] = static_cast<char>(byte);
      put("changed.pfm", other);
      try {
        if (const auto file = open_plain_pfm(folder_ / "changed.pfm")) all_rows(*file);
      } catch (const InputError&) {
      }
    }
}

}  // namespace
}  // namespace photonproof::inline scenes_images
