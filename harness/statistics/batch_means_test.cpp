#include "harness/statistics/batch_means.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "scenes/base/input_error.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_statistics {
namespace {

Image even(float value) {
  Image image(2, 1);
  std::fill(image.rgb.begin(), image.rgb.end(), value);
  return image;
}

TEST(BatchMeans, mean_and_variance_of_the_mean_are_those_of_the_batches) {
  // 1, 2, 6: mean 3, squared distances 4 + 1 + 9 = 14, variance of the mean 14 / (3 * 2) = 7/3.
  BatchMeans means(2, 1, 16);
  for (const float value : {1.0f, 2.0f, 6.0f}) means.add(even(value), "batch");
  EXPECT_EQ(means.batches(), 3);
  const Rendering rendering = means.rendering();
  for (const float v : rendering.mean.rgb) EXPECT_FLOAT_EQ(v, 3);
  for (const float v : rendering.variance->rgb) EXPECT_FLOAT_EQ(v, 7.0f / 3);
}

// Batches that state biases of 3 % and 4 % have sqrt((0.03^2 + 0.04^2) / 2) together, for any number of batches.
TEST(BatchMeans, bias_is_the_root_of_the_mean_square_of_what_the_batches_say) {
  BatchMeans means(2, 1, 16);
  EXPECT_EQ(means.relative_bias(), 0);
  for (int i = 0; i < 4; ++i) {
    means.add(even(1), "batch", 0.03 * 0.03);
    means.add(even(1), "batch", 0.04 * 0.04);
  }
  EXPECT_NEAR(means.relative_bias(), 0.0353553, 1e-7);
}

// Variances of radiances near 10^20 or 10^-20 are outside the range of floats: such a reference would have no noise
// bound.
TEST(BatchMeans, whose_variance_no_float_holds_are_refused) {
  BatchMeans means(2, 1, 16);
  for (const float radiance : {1e20f, 1e-20f}) {
    try {
      means.add(even(radiance), "batch 0");
      ADD_FAILURE() << radiance;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("give the scene's lights in another unit"), std::string::npos);
    }
  }
  EXPECT_EQ(means.batches(), 0);
}

class BatchMeansFile : public FolderTest {};

TEST_F(BatchMeansFile, going_on_from_it_gives_the_bits_of_never_having_stopped) {
  BatchMeans whole(2, 1, 16), stopped(2, 1, 16);
  for (int i = 0; i < 20; ++i) {
    const Image batch = even(1.0f / static_cast<float>(3 + i));
    whole.add(batch, "batch");
    stopped.add(batch, "batch");
    stopped.save(folder_ / "batches");
    stopped = BatchMeans::load(folder_ / "batches");
  }
  EXPECT_EQ(stopped.batches(), 20);
  EXPECT_EQ(stopped.samples_per_batch(), 16);
  EXPECT_EQ(stopped.rendering().mean.rgb, whole.rendering().mean.rgb);
  EXPECT_EQ(stopped.rendering().variance->rgb, whole.rendering().variance->rgb);
}

TEST_F(BatchMeansFile, damage_is_found) {
  BatchMeans means(2, 1, 16);
  means.add(even(1), "batch");
  means.save(folder_ / "batches");
  const std::string bytes = get("batches");
  const std::string damaged =
      (folder_ / "batches").string() + ": error: is damaged: delete it to begin this reference anew";
  const auto error = [&](const std::string& text) {
    put("batches", text);
    return input_error_of([&] { BatchMeans::load(folder_ / "batches"); });
  };
  for (const std::size_t left : {std::size_t{0}, std::size_t{30}, bytes.size() - 1})
    EXPECT_EQ(error(bytes.substr(0, left)), damaged) << left;
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    EXPECT_EQ(error(flipped), damaged) << at;
  }
}

TEST(BatchMeans, batch_that_is_broken_is_refused) {
  BatchMeans means(2, 1, 16);
  Image broken = even(1);
  broken.rgb[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(input_error_of([&] { means.add(broken, "batch 3"); }),
            "batch 3: error: has a value that is not finite: no reference can be made of it");
  EXPECT_EQ(input_error_of([&] { means.add(Image(1, 1), "batch 3"); }),
            "batch 3: error: is of another size than its batch");
  EXPECT_EQ(means.batches(), 0);
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
