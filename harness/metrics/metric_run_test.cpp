#include "harness/metrics/metric_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "harness/metrics/test_images.h"
#include "scenes/base/input_error.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_metrics {
namespace {

std::map<std::string, double> values_of(const std::vector<Measurement>& measurements) {
  std::map<std::string, double> values;
  for (const Measurement& measured : measurements)
    if (measured.value) values[measured.row->name] = *measured.value;
  return values;
}

std::map<std::string, double> every_value(const Image& reference, const Image& test, MetricOptions options) {
  options.also = {"hdr_flip", "differing", "differing_pixels"};
  return values_of(measure(reference, test, options));
}

/// A size of many tiles, with cut ones at the right and at the bottom.
constexpr int wide = 700, high = 300;

TEST(MetricRun, gives_the_same_bits_at_any_number_of_threads) {
  const Image reference = busy_image(wide, high, 2), test = busy_image(wide, high, 2, 2);
  MetricOptions options;
  options.threads = 1;
  const auto one = every_value(reference, test, options);
  EXPECT_EQ(one.size(), metric_rows().size());
  for (const int threads : {2, 7}) {
    options.threads = threads;
    EXPECT_EQ(every_value(reference, test, options), one) << threads;
  }
}

TEST(MetricRun, tiles_do_not_show) {
  // An image of one tile, and the same pixels mirrored to its right and below. Windows at the seams then cover other
  // pixels than replicated borders, so only the pixelwise metrics are the same.
  const Image reference = busy_image(90, 70, 2), test = busy_image(90, 70, 2, 2);
  const auto mirrored = [](const Image& image) {
    Image large(4 * image.width, 4 * image.height);
    for (int y = 0; y < large.height; ++y)
      for (int x = 0; x < large.width; ++x) {
        const int fold_x = x % (2 * image.width), fold_y = y % (2 * image.height);
        const int from_x = fold_x < image.width ? fold_x : 2 * image.width - 1 - fold_x;
        const int from_y = fold_y < image.height ? fold_y : 2 * image.height - 1 - fold_y;
        std::copy_n(image.pixel(from_x, from_y), 3, large.pixel(x, y));
      }
    return large;
  };
  const auto small = values_of(measure(reference, test, {}));
  const auto large = values_of(measure(mirrored(reference), mirrored(test), {}));
  for (const std::string name :
       {"mse", "mae", "max_abs", "bias", "relmse", "relmse_jeri", "mrse_pbrt", "smape", "psnr"})
    EXPECT_NEAR(large.at(name), small.at(name), 1e-12 * (1 + std::abs(small.at(name)))) << name;
}

TEST(MetricRun, windows_reach_across_tiles) {
  // Left and right of a seam between tiles at column 128, and of a column inside a tile. Where the filters do not reach
  // the border, the maps shifted by 64 pixels are the same.
  const Image noise = busy_image(400, 40), other = busy_image(400, 40, 1, 2);
  const auto shifted = [](const Image& image) {
    Image part(336, 40);
    for (int y = 0; y < 40; ++y) std::copy_n(image.pixel(64, y), 3 * 336, part.pixel(0, y));
    return part;
  };
  const auto whole = flip_map(noise, other, {}), part = flip_map(shifted(noise), shifted(other), {});
  for (int y = 0; y < 40; ++y)
    for (int x = 10; x < 336; ++x)
      EXPECT_EQ(part[static_cast<std::size_t>(336 * y + x)], whole[static_cast<std::size_t>(400 * y + x + 64)])
          << x << " " << y;
}

TEST(MetricRun, region_is_as_if_the_images_had_been_cropped) {
  const Image reference = busy_image(wide, high, 2), test = busy_image(wide, high, 2, 2);
  const PixelRegion region{131, 17, 200, 170};
  const auto cropped = [&](const Image& image) {
    Image part(region.width, region.height);
    for (int y = 0; y < region.height; ++y)
      std::copy_n(image.pixel(region.x, region.y + y), 3 * region.width, part.pixel(0, y));
    return part;
  };
  MetricOptions options;
  options.region = region;
  EXPECT_EQ(every_value(reference, test, options), every_value(cropped(reference), cropped(test), {}));
  EXPECT_EQ(measure(reference, test, options)[0].parameters, "region=131 17 200 170");
  options.region = PixelRegion{wide - 10, 0, 11, 5};
  EXPECT_THROW(measure(reference, test, options), InputError);
}

std::shared_ptr<PixelMask> empty_mask(int width, int height) { return std::make_shared<PixelMask>(width, height); }

TEST(MetricRun, mask_of_everything_changes_nothing) {
  const Image reference = busy_image(wide, high, 2), test = busy_image(wide, high, 2, 2);
  const auto mask = empty_mask(wide, high);
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) mask->set(x, y);
  MetricOptions options;
  options.mask = mask;
  auto whole = every_value(reference, test, {});
  whole.erase("ms_ssim");  // undefined under a mask
  const auto masked = every_value(reference, test, options);
  ASSERT_EQ(masked.size(), whole.size());
  for (const auto& [name, value] : whole) EXPECT_DOUBLE_EQ(masked.at(name), value) << name;
}

TEST(MetricRun, mask_counts_its_pixels_alone) {
  // 100 of 2000 pixels count; 10 of those are off by 1 from 1 in all channels, as are 500 that do not count.
  const Image reference = constant_image(50, 40, 1, 1, 1);
  Image test = reference;
  const auto mask = empty_mask(50, 40);
  for (int i = 0; i < 100; ++i) mask->set(i % 50, i / 50);
  for (int i = 0; i < 10; ++i)
    for (int c = 0; c < 3; ++c) test.pixel(i, 0)[c] = 2;
  for (int i = 0; i < 500; ++i)
    for (int c = 0; c < 3; ++c) test.pixel(i % 50, 20 + i / 50)[c] = 2;
  MetricOptions options;
  options.mask = mask;
  options.mask_name = "m.png";
  const auto values = values_of(measure(reference, test, options));
  EXPECT_DOUBLE_EQ(values.at("mse"), 0.1);
  EXPECT_DOUBLE_EQ(values.at("mae"), 0.1);
  EXPECT_DOUBLE_EQ(values.at("bias"), 0.1);
  EXPECT_DOUBLE_EQ(values.at("relmse"), 0.1 / 1.01);
  EXPECT_DOUBLE_EQ(values.at("smape"), 0.1 * 2 / 3.02);
  EXPECT_EQ(measure(reference, test, options)[0].parameters, "mask=m.png");
}

TEST(MetricRun, windowed_metrics_average_their_maps_over_the_mask) {
  const Image reference = busy_image(60, 50), test = busy_image(60, 50, 1, 2);
  const auto mask = empty_mask(60, 50);
  const auto map = flip_map(reference, test, {});
  double sum = 0;
  for (int y = 3; y < 44; y += 2)
    for (int x = 0; x < 60; x += 3) {
      mask->set(x, y);
      sum += static_cast<double>(map[static_cast<std::size_t>(60 * y + x)]);
    }
  MetricOptions options;
  options.mask = mask;
  const auto values = values_of(measure(reference, test, options));
  EXPECT_NEAR(values.at("flip"), sum / (21 * 20), 1e-12);
  EXPECT_EQ(values.count("ms_ssim"), 0u);
}

TEST(MetricRun, mask_of_another_size_is_refused) {
  MetricOptions options;
  options.mask = empty_mask(11, 12);
  options.mask_name = "m.png";
  const Image image = busy_image(12, 12);
  try {
    measure(image, image, options);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "m.png: error: mask is 11x12 pixels, what it should choose from 12x12");
  }
}

/// Rows that are computed on request; it records the distance of the rows of one call.
class MadeRows : public RowSource {
 public:
  explicit MadeRows(unsigned seed) : seed_(seed) {}
  int width() const override { return 300; }
  int height() const override { return 3000; }
  void read(int begin, int end, float* rgb) override {
    EXPECT_EQ(begin, next_) << "rows are read once, in order";
    next_ = end;
    for (int y = begin; y < end; ++y) {
      const Image row = busy_image(width(), 1, 2, seed_ + 977 * static_cast<unsigned>(y));
      rgb = std::copy(row.rgb.begin(), row.rgb.end(), rgb);
    }
  }

 private:
  unsigned seed_;
  int next_ = 0;
};

TEST(MetricRun, bands_of_rows_give_what_whole_images_do) {
  MadeRows reference(1), test(2);
  const auto streamed = measure_pair(reference, test, {});
  Image whole_reference(300, 3000), whole_test(300, 3000);
  MadeRows(1).read(0, 3000, whole_reference.rgb.data());
  MadeRows(2).read(0, 3000, whole_test.rgb.data());
  EXPECT_EQ(values_of(streamed.measurements), values_of(measure(whole_reference, whole_test, {})));

  // The 900 worst of 900 000 pixels, found with few of them in memory, against a sort of all.
  auto errors = relmse_map(whole_reference, whole_test);
  std::sort(errors.begin(), errors.end());
  double sum = 0;
  for (std::size_t i = 0; i < errors.size() - 900; ++i) sum += static_cast<double>(errors[i]);
  EXPECT_NEAR(values_of(streamed.measurements).at("relmse_trimmed"), sum / (900000 - 900),
              1e-7);  // the map holds floats
}

class MetricRunFiles : public FolderTest {};

TEST_F(MetricRunFiles, image_file_gives_what_the_image_does) {
  const Image reference = busy_image(140, 150, 2), test = busy_image(140, 150, 2, 2);
  for (const auto& [name, image] : {std::pair{"r.exr", &reference}, {"t.exr", &test}})
    write_exr((folder_ / name).string(), {*image, std::nullopt, {}});
  FileSource reference_file((folder_ / "r.exr").string()), test_file((folder_ / "t.exr").string());
  EXPECT_EQ(values_of(measure_pair(reference_file, test_file, {}).measurements),
            values_of(measure(reference, test, {})));
}

TEST_F(MetricRunFiles, value_that_is_not_finite_in_a_late_band_still_stops_every_metric) {
  MadeRows reference(1);
  class Broken : public MadeRows {
   public:
    Broken() : MadeRows(2) {}
    void read(int begin, int end, float* rgb) override {
      MadeRows::read(begin, end, rgb);
      for (const int y : {2990, 2900})
        if (begin <= y && y < end) rgb[3 * (300 * (y - begin) + 7) + 1] = std::nanf("");
    }
  } test;
  const auto result = measure_pair(reference, test, {});
  ASSERT_EQ(result.defects.size(), 1u);
  EXPECT_EQ(result.defects[0].sentence, "pixel (7, 2900) of the test image is NaN in G; 2 non-finite in all");
  EXPECT_TRUE(result.measurements.empty());
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
