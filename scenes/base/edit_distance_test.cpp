#include "scenes/base/edit_distance.h"

#include <gtest/gtest.h>

namespace photonproof::inline scenes_base {
namespace {

TEST(edit_distance, counts_the_single_typing_errors) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("sphere", "spere"), 1u);   // one left out
  EXPECT_EQ(edit_distance("sphere", "sphree"), 1u);  // two swapped
  EXPECT_EQ(edit_distance("sphere", "spheres"), 1u);
  EXPECT_EQ(edit_distance("sphere", "sphare"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // k-s, e-i, +g
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);          // no letter is edited twice, so not 2
}

TEST(did_you_mean, names_the_nearest_and_only_when_it_is_near) {
  const std::vector<std::string> names = {"sphere", "rectangle", "cube"};
  EXPECT_EQ(did_you_mean("rectangel", names), " (did you mean 'rectangle'?)");
  EXPECT_EQ(did_you_mean("cub", names), " (did you mean 'cube'?)");
  EXPECT_EQ(did_you_mean("disk", names), "");
  EXPECT_EQ(did_you_mean("x", {}), "");
  EXPECT_EQ(did_you_mean(std::string(1000, 'a'), names), "");
}

TEST(join_or, reads_like_a_sentence) {
  EXPECT_EQ(join_or({}), "nothing");
  EXPECT_EQ(join_or({"a"}), "a");
  EXPECT_EQ(join_or({"a", "b", "c"}), "a, b or c");
}

}  // namespace
}  // namespace photonproof::inline scenes_base
