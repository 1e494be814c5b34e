// HDR-FLIP: Andersson, Nilsson, Shirley, Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021. Both images are exposed and tone-mapped several times, and compared by LDR-FLIP each time. A
// pixel's error is its largest. Tone mapping is Narkowicz's fit of ACES without its pre-exposure of 0.6,
//   t(x) = (0.9036 x^2 + 0.018 x) / (0.8748 x^2 + 0.354 x + 0.14).
// Its values count as linear ones, and radiance is clamped to [0, 65536], as in NVIDIA's tool.

#include "harness/metrics/metric_hdr_flip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "harness/metrics/metric_flip.h"
#include "harness/metrics/metric_rows.h"
#include "harness/pixels/row_source.h"

namespace photonproof::inline harness_metrics {
namespace {

/// The solution of t(x) = 0.85, the paper's target for the brightest and the median pixel: a x^2 + b x + c = 0.
double exposed_value() {
  constexpr double t = 0.85;
  const double a = 0.6 * 0.6 * (2.51 - 2.43 * t), b = 0.6 * (0.03 - 0.59 * t), c = -0.14 * t;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

constexpr double least_median = std::numeric_limits<float>::epsilon();

float luminance(const float* rgb) {
  const auto channel = [&](int c) { return std::clamp(rgb[c], 0.0f, 65536.0f); };
  return 0.2126f * channel(0) + 0.7152f * channel(1) + 0.0722f * channel(2);
}

/// visit(luminance) of every pixel that is a number.
template <class Visit>
void for_each_luminance(RowSource& image, const Visit& visit) {
  constexpr int rows = 64;
  const auto width = static_cast<std::size_t>(image.width());
  std::vector<float> rgb(3 * width * rows);
  for (int y = 0; y < image.height(); y += rows) {
    const int end = std::min(image.height(), y + rows);
    image.read(y, end, rgb.data());
    const std::size_t values = 3 * width * static_cast<std::size_t>(end - y);
    for (std::size_t i = 0; i < values; i += 3) visit(luminance(&rgb[i]));
  }
}

using Counts = std::vector<std::uint64_t>;

/// The bin of the value with this rank, counted from 0; `rank` becomes the rank within the bin.
std::uint32_t bin_of(const Counts& counts, std::uint64_t& rank) {
  std::uint32_t bin = 0;
  while (rank >= counts[bin]) rank -= counts[bin++];
  return bin;
}

struct Luminances {
  double greatest = 0, median = 0;  ///< `median` of an even number: the mean of the middle two.
};

/// The exact values: the bits of non-negative floats sort like integers, first by their upper and then by their lower
/// half.
Luminances luminances_of(RowSource& image) {
  Luminances found;
  Counts upper(1 << 16);
  std::uint64_t pixels = 0;
  for_each_luminance(image, [&](float y) {
    found.greatest = std::max(found.greatest, static_cast<double>(y));
    ++upper[std::bit_cast<std::uint32_t>(y) >> 16 & 0x7fff];
    ++pixels;
  });
  std::array<std::uint64_t, 2> ranks = {(pixels - 1) / 2, pixels / 2};
  std::array<std::uint32_t, 2> bins{};
  for (std::size_t i = 0; i < 2; ++i) bins[i] = bin_of(upper, ranks[i]);
  std::array<Counts, 2> lower = {Counts(1 << 16), Counts(1 << 16)};
  for_each_luminance(image, [&](float y) {
    const auto bits = std::bit_cast<std::uint32_t>(y) & 0x7fffffff;
    for (std::size_t i = 0; i < 2; ++i)
      if (bits >> 16 == bins[i]) ++lower[i][bits & 0xffff];
  });
  for (std::size_t i = 0; i < 2; ++i)
    found.median += 0.5 * static_cast<double>(std::bit_cast<float>(bins[i] << 16 | bin_of(lower[i], ranks[i])));
  return found;
}

class HdrFlipPass : public MetricPass {
 public:
  explicit HdrFlipPass(const PairFacts& pair)
      : range_(pair.options.parameters.hdr_exposures), pool_(range_ ? pair.counted : 0) {}

  void measure(const PairTile& tile, const TileMaps&, Part&) override {
    if (!range_) return;
    const TileMemory::Frame frame(tile.memory());
    const std::size_t pixels = tile.pixels();
    auto* greatest = tile.memory().take<std::uint32_t>(pixels);
    auto* steps = tile.memory().take<std::uint32_t>(pixels);
    std::fill_n(greatest, pixels, 0u);
    for (int i = 0; i < range_->count; ++i) {
      const TileMemory::Frame exposure_frame(tile.memory());
      const double share = range_->count > 1 ? static_cast<double>(i) / (range_->count - 1) : 0.0;
      const double scale = std::exp2(range_->start + share * (range_->stop - range_->start));
      flip_errors(tone_mapped(tile, 0, scale), tone_mapped(tile, 1, scale), static_cast<std::size_t>(tile.width()),
                  static_cast<std::size_t>(tile.height()), tile.memory(), steps);
      for (std::size_t p = 0; p < pixels; ++p) greatest[p] = std::max(greatest[p], steps[p]);
    }
    pool_.add(tile, greatest);
  }

  void add(const Part&) override {}

  std::optional<double> value(std::size_t) const override {
    if (!range_) return std::nullopt;
    return pool_.mean();
  }

 private:
  static TileColour tone_mapped(const PairTile& tile, std::size_t which, double scale) {
    TileColour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
      const PairTile::LinearPlane linear = tile.linear(which, c);
      auto* plane = tile.memory().take<double>(linear.size);
      pixel_loops().tone_map(linear.first, linear.size, scale, plane);
      colour[c] = {plane + PairTile::reach * linear.stride + PairTile::reach, linear.stride};
    }
    return colour;
  }

  std::optional<ExposureRange> range_;
  FlipPool pool_;
};

}  // namespace

std::optional<ExposureRange> exposures_of(RowSource& reference) {
  const Luminances found = luminances_of(reference);
  if (found.greatest <= 0) return std::nullopt;
  // Where most of the image is black, the last exposure would be infinite. NVIDIA's tool 1.7 then takes 2^-23 for the
  // median. An even darker image has one exposure, that of its brightest pixel.
  const double median = std::max(found.median, std::min(least_median, found.greatest));
  const double start = std::log2(exposed_value() / found.greatest), stop = std::log2(exposed_value() / median);
  return ExposureRange{start, stop, std::max(2, static_cast<int>(std::ceil(stop - start)))};
}

std::unique_ptr<MetricPass> hdr_flip_pass(const PairFacts& pair) { return std::make_unique<HdrFlipPass>(pair); }

std::string hdr_flip_parameters() { return "tone_mapper=ACES, exposures, pixels_per_degree=67.0206"; }

void derive_hdr_exposures(ParameterValues& values, RowSource& reference) {
  if (!values.hdr_exposures) values.hdr_exposures = exposures_of(reference);
}

}  // namespace photonproof::inline harness_metrics
