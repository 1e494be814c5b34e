#include "reports/view/flip_values.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "reports/record/heatmap_magma.h"
#include "reports/view/temporary_folder.h"

namespace photonproof::reports::inline reports_view {
namespace {

class FlipValues : public testing::Test {
 protected:
  /// A picture of one row in these colours.
  void draw(const std::string& name, const std::vector<std::uint32_t>& colours) const {
    PngRows file((folder.path() / name).string(), static_cast<int>(colours.size()), 1);
    std::vector<std::uint8_t> bytes;
    for (const std::uint32_t colour : colours)
      for (const int shift : {16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(colour >> shift));
    file.add(1, bytes.data());
    file.finish();
  }
  TemporaryFolder folder;
};

// Two equal neighbours in the table would give the lower value, 1/255 off; the test shows that there are none.
TEST_F(FlipValues, every_colour_of_the_map_is_its_own_value) {
  EXPECT_EQ(std::set<std::uint32_t>(magma_colours.begin(), magma_colours.end()).size(), 256u);
  draw("all.png", {magma_colours.begin(), magma_colours.end()});
  const auto values = flip_values(folder.path(), "all.png");
  ASSERT_TRUE(values);
  for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(values->rgb[3 * i], static_cast<float>(i) / 255.0f) << i;
}

TEST_F(FlipValues, picture_of_other_colours_has_none) {
  draw("other.png", {magma_colours[0], 0xff0000});
  EXPECT_FALSE(flip_values(folder.path(), "other.png"));
  EXPECT_FALSE(flip_values(folder.path(), "none.png"));
  EXPECT_FALSE(flip_values(folder.path(), ""));
  std::ofstream(folder.path() / "broken.png") << "no picture";
  EXPECT_FALSE(flip_values(folder.path(), "broken.png"));
}

// A ramp with differences of 1 deflates to almost nothing; 65536 bytes of noise do not shrink.
TEST_F(FlipValues, smooth_maps_take_few_bytes) {
  Image ramp(256, 256);
  for (std::size_t i = 0; i < ramp.rgb.size(); ++i) ramp.rgb[i] = static_cast<float>(i / 3 % 256) / 255.0f;
  EXPECT_LT(packed_flip(ramp).size(), 500u);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
