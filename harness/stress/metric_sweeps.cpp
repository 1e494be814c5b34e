// Metrics of images whose errors are known: in closed form, by an independent sum here in double, or since nothing that
// a metric uses has changed.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/stress/compared.h"
#include "harness/stress/sweep_rows.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

struct Pair {
  Image reference, test;
};

double tenth(double k) { return std::pow(10.0, k); }

/// 24 x 16 pixels between 0.2 and 1, and the same with errors of up to 10 %, without symmetry.
Pair off_by_a_tenth(double factor = 1) {
  Pair pair{Image(24, 16), Image(24, 16)};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) {
        const double r = 0.2 + 0.05 * ((3 * x + 5 * y + 7 * c) % 17);
        pair.reference.pixel(x, y)[c] = static_cast<float>(r * factor);
        pair.test.pixel(x, y)[c] = static_cast<float>(r * factor * (1 + 0.1 * ((5 * x + 3 * y + c) % 7 - 3) / 3));
      }
  return pair;
}

Pair flat(int width, int height, float reference, float test) {
  Pair pair{Image(width, height), Image(width, height)};
  std::fill(pair.reference.rgb.begin(), pair.reference.rgb.end(), reference);
  std::fill(pair.test.rgb.begin(), pair.test.rgb.end(), test);
  return pair;
}

/// The mean over values of `of(x, r)`.
template <class Of>
double mean_over(const Pair& pair, const Of& of) {
  double sum = 0;
  for (std::size_t i = 0; i < pair.test.rgb.size(); ++i)
    sum += of(double{pair.test.rgb[i]}, double{pair.reference.rgb[i]});
  return sum / static_cast<double>(pair.test.rgb.size());
}

/// Metrics by the definitions of docs/metrics.md.
std::vector<KnownMetric> linear_metrics(const Pair& pair) {
  const double mse = mean_over(pair, [](double x, double r) { return (x - r) * (x - r); });
  const auto relative = [&](double epsilon) {
    return mean_over(pair, [=](double x, double r) { return (x - r) * (x - r) / (r * r + epsilon); });
  };
  double largest = 0;
  for (std::size_t i = 0; i < pair.test.rgb.size(); ++i)
    largest = std::max(largest, std::abs(double{pair.test.rgb[i]} - double{pair.reference.rgb[i]}));
  std::vector<KnownMetric> known{
      {"mse", mse},
      {"rmse", std::sqrt(mse)},
      {"mae", mean_over(pair, [](double x, double r) { return std::abs(x - r); })},
      {"max_abs", largest},
      {"relmse", relative(0.01)},
      {"relmse_jeri", relative(0.0001)},
      {"mrse_pbrt", mean_over(pair, [](double x, double r) { return (x - r) * (x - r) / ((r + 0.01) * (r + 0.01)); })},
      {"smape",
       mean_over(pair, [](double x, double r) { return 2 * std::abs(x - r) / (std::abs(x) + std::abs(r) + 0.02); })}};
  const double level = mean_over(pair, [](double, double r) { return r; });
  std::optional<double> bias;
  if (level != 0) bias = mean_over(pair, [](double x, double r) { return x - r; }) / level;
  known.push_back({"bias", bias, 1e-4});
  return known;
}

LevelVerdict compare_pair(const StressRunner& runner, const Pair& pair, const std::vector<KnownMetric>& known,
                          const std::vector<std::string>& arguments = {}) {
  const ScratchFolder scratch("stress");
  const fs::path reference = scratch.path() / "reference.exr", test = scratch.path() / "test.exr";
  write_exr(reference.string(), {pair.reference, {}, {}});
  write_exr(test.string(), {pair.test, {}, {}});
  return compare_files(runner, reference, test, known, arguments);
}

using MakePair = std::function<Pair(double)>;

Sweep metric_sweep(const char* sweep_run, const char* measure, const std::vector<double>& heights, double wanted,
                   const std::function<LevelVerdict(double, const StressRunner&)>& measured) {
  Sweep sweep{"metrics", sweep_run, measure, heights, wanted, {}};
  sweep.engines = {"compare"};
  sweep.measured = measured;
  return sweep;
}

Sweep linear(const char* sweep_run, const char* measure, const std::vector<double>& heights, double wanted,
             const MakePair& make) {
  return metric_sweep(sweep_run, measure, heights, wanted, [=](double k, const StressRunner& runner) {
    const Pair pair = make(k);
    return compare_pair(runner, pair, linear_metrics(pair));
  });
}

/// A value that is not a number in the last pixel of the test image, or of the reference.
Sweep no_numbers_in_images() {
  Sweep sweep =
      metric_sweep("no number", "k-th of nan, inf, -inf in the test, then in the reference", {0, 1, 2, 3, 4, 5}, -1,
                   [](double k, const StressRunner& runner) -> LevelVerdict {
                     constexpr float infinity = std::numeric_limits<float>::infinity();
                     const float values[] = {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity};
                     Pair pair = off_by_a_tenth();
                     (k < 3 ? pair.test : pair.reference).rgb.back() = values[static_cast<int>(k) % 3];
                     LevelVerdict verdict = compare_pair(runner, pair, {{"mse", {}}, {"ssim", {}}, {"flip", {}}});
                     if (verdict.outcome != LevelOutcome::refused && verdict.outcome != LevelOutcome::crashed)
                       return {LevelOutcome::silently_wrong, "was compared, though a value is not a number", {}};
                     return verdict;
                   });
  sweep.goes_on = true;
  return sweep;
}

double encoded(double linear_value) {
  const double v = std::clamp(linear_value, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// Metrics of two grey images, in which all windows are alike.
std::vector<KnownMetric> flat_display_metrics(const Pair& pair) {
  const double r = encoded(double{pair.reference.rgb[0]}), x = encoded(double{pair.test.rgb[0]});
  std::optional<double> psnr, ssim;
  if (x != r) psnr = -10 * std::log10((x - r) * (x - r));
  if (std::min(pair.test.width, pair.test.height) >= 11) ssim = (2 * x * r + 1e-4) / (x * x + r * r + 1e-4);
  return {{"psnr", psnr, 1e-4}, {"ssim", ssim, 1e-4}};
}

std::vector<Sweep> sizes_of_images() {
  const auto sweep_run = [](const char* name, const char* measure, const std::vector<double>& heights, double wanted,
                            const std::function<std::pair<int, int>(int)>& size) {
    return metric_sweep(name, measure, heights, wanted, [=](double n, const StressRunner& runner) {
      const auto [width, height] = size(static_cast<int>(n));
      const Pair pair = flat(width, height, 0.5f, 0.6f);
      std::vector<KnownMetric> known = linear_metrics(pair);
      for (const KnownMetric& metric : flat_display_metrics(pair)) known.push_back(metric);
      return compare_pair(runner, pair, known);
    });
  };
  const std::vector<double> sides{1, 2, 10, 11, 12, 1000, 10000, 30000};
  return {
      sweep_run("wide", "k x 1 pixels", sides, 30000, [](int n) { return std::pair(n, 1); }),
      sweep_run("high", "1 x k pixels", sides, 30000, [](int n) { return std::pair(1, n); }),
      sweep_run("large", "k x k pixels", {1, 2, 10, 11, 12, 101, 1000}, 1000, [](int n) { return std::pair(n, n); }),
      sweep_run("long", "k x 12 pixels", sides, 30000, [](int n) { return std::pair(n, 12); })};
}

/// Images times 2^k, exposures k stops lower: nothing changes on the display.
Sweep exposed() {
  return metric_sweep("brighter, exposed less", "images times 2^k, k stops less", {-64, -40, -10, 10, 40, 64}, 64,
                      [](double k, const StressRunner& runner) {
                        const std::vector<std::string> names{"psnr", "ssim", "flip", "flip_max"};
                        const ScratchFolder scratch("stress");
                        const fs::path r = scratch.path() / "r.exr", t = scratch.path() / "t.exr";
                        const Pair plain = off_by_a_tenth();
                        write_exr(r.string(), {plain.reference, {}, {}});
                        write_exr(t.string(), {plain.test, {}, {}});
                        return compare_pair(runner, off_by_a_tenth(std::exp2(k)), printed_metrics(runner, r, t, names),
                                            {"--exposure", std::to_string(static_cast<int>(-k))});
                      });
}

Sweep black_ones() {
  return metric_sweep("black", "k-th of both, the reference, the test", {0, 1, 2}, 2,
                      [](double k, const StressRunner& runner) {
                        const Pair pair = flat(24, 16, k == 2 ? 0.5f : 0.0f, k == 1 ? 0.5f : 0.0f);
                        std::vector<KnownMetric> known = linear_metrics(pair);
                        for (const KnownMetric& metric : flat_display_metrics(pair)) known.push_back(metric);
                        if (k == 0) known.push_back({"flip", 0});
                        return compare_pair(runner, pair, known);
                      });
}

Sweep single_channels() {
  return metric_sweep("one channel", "10 % more in the k-th of R, G, B", {0, 1, 2}, 2,
                      [](double k, const StressRunner& runner) {
                        Pair pair = off_by_a_tenth();
                        pair.test = pair.reference;
                        for (std::size_t i = static_cast<std::size_t>(k); i < pair.test.rgb.size(); i += 3)
                          pair.test.rgb[i] *= 1.1f;
                        return compare_pair(runner, pair,
                                            {{"bias_r", k == 0 ? 0.1 : 0, 1e-4},
                                             {"bias_g", k == 1 ? 0.1 : 0, 1e-4},
                                             {"bias_b", k == 2 ? 0.1 : 0, 1e-4}});
                      });
}

}  // namespace

std::vector<Sweep> metric_sweeps(const fs::path&) {
  std::vector<Sweep> sweeps{
      linear("images up", "both times 10^k", {3, 9, 15, 19, 25, 30, 37}, 30,
             [](double k) { return off_by_a_tenth(tenth(k)); }),
      linear("images down", "both times 10^-k; from 38 on denormal", {3, 9, 15, 19, 25, 30, 37, 40, 44}, 30,
             [](double k) { return off_by_a_tenth(tenth(-k)); }),
      linear("negative", "both times -10^k", {-9, 0, 9, 19, 30}, 30,
             [](double k) { return off_by_a_tenth(-tenth(k)); }),
      linear("small difference", "off by 10^-k of the value", {1, 2, 3, 4, 5, 6}, 6,
             [](double k) {
               Pair pair = off_by_a_tenth();
               for (std::size_t i = 0; i < pair.test.rgb.size(); ++i)
                 pair.test.rgb[i] = pair.reference.rgb[i] * (1 + static_cast<float>(tenth(-k)));
               return pair;
             }),
      linear("one bright pixel", "10^k in one value of the test", {3, 10, 20, 30, 38}, 30,
             [](double k) {
               Pair pair = off_by_a_tenth();
               pair.test.rgb[100] = static_cast<float>(tenth(k));
               return pair;
             }),
      exposed(),
      black_ones(),
      single_channels(),
      no_numbers_in_images()};
  for (const Sweep& sweep : sizes_of_images()) sweeps.push_back(sweep);
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
