#include "harness/pixels/metric_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "harness/metrics/test_images.h"
#include "harness/pixels/display.h"

namespace photonproof::inline harness_pixels {
namespace {

std::vector<const PixelLoops*> every_instruction_set() {
  std::vector<const PixelLoops*> sets;
  for (const auto* at = available_pixel_loops(); *at; ++at) sets.push_back(*at);
  return sets;
}

TEST(MetricFilter, gaussian_sums_to_one_and_falls_off_as_it_should) {
  const Taps taps = gaussian_taps(1.5, 5);
  double sum = taps.weight[0];
  for (int k = 1; k <= 5; ++k) sum += 2 * taps.weight[k];
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(taps.weight[3] / taps.weight[0], std::exp(-2), 1e-15);  // 3^2 / (2 1.5^2) = 2
}

TEST(MetricFilter, taps_read_the_neighbours_on_either_side) {
  // A ramp of slope 1 along x and 100 along y: an even kernel of sum 1 returns the middle value. An odd kernel returns
  // the slope times sum_k 2 k w_k = 2 (1 + ... + 9) = 90, with all w_k = 1.
  const int reach = 10;
  const std::size_t width = 21, height = 4, stride = width + 2 * reach;
  std::vector<double> plane(stride * (height + 2 * reach));
  for (std::size_t y = 0; y < height + 2 * reach; ++y)
    for (std::size_t x = 0; x < stride; ++x)
      plane[y * stride + x] = static_cast<double>(x) + 100 * static_cast<double>(y);
  const Taps odd{9, {0, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
  const double* core = plane.data() + reach * stride + reach;
  std::vector<double> out(width * height), other(width * height);
  const FilterSpan across{core, stride, 1, width, height};
  const FilterSpan down{core, stride, static_cast<std::ptrdiff_t>(stride), width, height};
  for (const PixelLoops* loops : every_instruction_set()) {
    for (const int radius : {5, 7, 9, 10}) {
      const Taps taps = gaussian_taps(2, radius);
      loops->filter(across, {taps, out.data(), width});
      EXPECT_NEAR(out[width + 7], core[stride + 7], 1e-11) << loops->isa;
      loops->filter(down, {taps, out.data(), width});
      EXPECT_NEAR(out[3 * width + 20], core[3 * stride + 20], 1e-11) << loops->isa;
    }
    const Taps wide = gaussian_taps(3, 10), narrow = gaussian_taps(2, 10), even = gaussian_taps(2, 9);
    loops->filter_twice(down, {wide, out.data(), width}, {narrow, other.data(), width});
    EXPECT_NEAR(out[5], core[5], 1e-11) << loops->isa;
    EXPECT_NEAR(other[width + 5], core[stride + 5], 1e-11) << loops->isa;
    loops->filter_odd_even(across, {odd, out.data(), width}, {even, other.data(), width});
    EXPECT_NEAR(out[20], 90, 1e-11) << loops->isa;
    EXPECT_NEAR(other[20], core[20], 1e-11) << loops->isa;
    loops->filter_odd_even(down, {odd, out.data(), width}, {even, other.data(), width});
    EXPECT_NEAR(out[3 * width], 9000, 1e-9) << loops->isa;
  }
}

TEST(MetricFilter, weights_meet_the_values_at_their_distance) {
  // An impulse gives the kernel itself.
  const std::size_t width = 21;
  std::vector<double> plane(width + 20), out(width);
  plane[20] = 1;
  const Taps taps = gaussian_taps(2, 7);
  for (const PixelLoops* loops : every_instruction_set()) {
    loops->filter({plane.data() + 10, width + 20, 1, width, 1}, {taps, out.data(), width});
    for (int x = 0; x < 21; ++x)
      EXPECT_EQ(out[static_cast<std::size_t>(x)], std::abs(x - 10) <= 7 ? taps.weight[std::abs(x - 10)] : 0.0);
  }
}

TEST(MetricFilter, rows_from_anywhere_are_weighed_by_their_place_in_the_list) {
  // Row k holds 10^k, so the result's digits are the weights. The weights weight[|k - 5|] = |k - 5| + 1 make them 6 5 4
  // 3 2 1 2 3 4 5 6.
  const Taps taps{5, {1, 2, 3, 4, 5, 6}};
  const std::size_t width = 37;
  std::vector<std::vector<double>> rows;
  std::vector<const double*> places;
  for (int k = 0; k < 11; ++k) places.push_back(rows.emplace_back(width, std::pow(10.0, k)).data());
  for (const PixelLoops* loops : every_instruction_set()) {
    std::vector<double> out(width);
    loops->filter_rows(places.data(), taps, width, out.data());
    for (const double v : out) EXPECT_EQ(v, 65432123456.0) << loops->isa;
  }
}

TEST(PixelLoops, encoding_is_the_standards_formula) {
  std::vector<double> linear, encoded(4097);
  for (int i = 0; i <= 4096; ++i) linear.push_back(i / 4096.0);
  for (const PixelLoops* loops : every_instruction_set()) {
    loops->encode(linear.data(), linear.size(), encoded.data());
    for (std::size_t i = 0; i < linear.size(); ++i) EXPECT_NEAR(encoded[i], encode_srgb(linear[i]), 2e-14) << linear[i];
  }
}

TEST(PixelLoops, every_instruction_set_gives_the_same_bits) {
  // FLIP calls all of the elementary functions; 37 is no multiple of any vector width.
  const std::size_t n = 37;
  const Image image = busy_image(static_cast<int>(n), 4);
  std::vector<double> in[8];
  for (std::size_t p = 0; p < 8; ++p)
    for (std::size_t i = 0; i < n; ++i) in[p].push_back(static_cast<double>(image.rgb[p * n + i]));
  std::vector<std::uint32_t> first;
  for (const PixelLoops* loops : every_instruction_set()) {
    std::vector<double> out[10];
    for (auto& plane : out) plane.resize(n);
    const auto at = [&](std::size_t i) { return out[i].data(); };
    const LabPlanes a{at(0), at(1), at(2)}, b{at(3), at(4), at(5)};
    loops->perceived(in[0].data(), in[1].data(), in[2].data(), in[3].data(), 0.7, n, a);
    loops->perceived(in[4].data(), in[5].data(), in[6].data(), in[7].data(), 0.7, n, b);
    const FeaturePlanes fa{at(6), at(7)}, fb{at(8), at(9)};
    loops->magnitude(in[0].data(), in[1].data(), n, fa.edge);
    loops->magnitude(in[2].data(), in[3].data(), n, fa.point);
    loops->magnitude(in[4].data(), in[5].data(), n, fb.edge);
    loops->magnitude(in[6].data(), in[7].data(), n, fb.point);
    std::vector<std::uint32_t> steps(n);
    loops->flip_error(a, b, fa, fb, 41.28, n, steps.data());
    std::vector<double> encoded(n), ssim(n), structure(n);
    loops->encode(in[0].data(), n, encoded.data());
    loops->similarity(in[0].data(), in[1].data(), in[2].data(), in[3].data(), n, ssim.data(), structure.data());
    for (auto* plane : {&encoded, &ssim, &structure, &out[0], &out[1], &out[5]})
      for (const double v : *plane) {
        std::uint32_t words[2];
        std::memcpy(words, &v, sizeof v);
        steps.insert(steps.end(), words, words + 2);
      }
    if (first.empty()) first = steps;
    EXPECT_EQ(steps, first) << loops->isa;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_pixels
