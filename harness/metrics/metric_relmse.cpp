// The mean of (x-r)^2/(r^2+epsilon), epsilon = 0.01, as in tev and SimpleImageIO (Rousselle, Knaus, Zwicker: "Adaptive
// sampling and reconstruction using greedy error minimization", 2011). The trimmed variant, relmse_trimmed, leaves out
// the floor(pixels/1000) pixels of greatest error, which on caustics are a few fireflies. SimpleImageIO's newer
// releases rank channel values where we rank pixels; its older ones rank pixels too.
//
// Ranking needs memory only for the pixels that may be left out. Those over a threshold are kept aside. When they are
// many, the smaller ones are added to the sum after all and the threshold rises.

#include <algorithm>
#include <iterator>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

constexpr double kEpsilon = 0.01;
constexpr std::uint64_t kOnePixelIn = 1000;

class RelmsePass : public MetricPass {
 public:
  explicit RelmsePass(const PairFacts& pair) : pixels_(pair.counted), trimmed_(pair.counted / kOnePixelIn) {}

  /// The part holds the sum over all pixels, then the sum over those up to the threshold, then the errors over it.
  void measure(const PairTile& tile, const TileMaps& maps, Part& part) override {
    const auto r0 = tile.reference(0), r1 = tile.reference(1), r2 = tile.reference(2);
    const auto x0 = tile.test(0), x1 = tile.test(1), x2 = tile.test(2);
    const std::size_t count = r0.size();
    const TileMemory::Frame frame(tile.memory());
    double* errors = tile.memory().take<double>(count);
    write_errors(r0, x0, r1, x1, r2, x2, errors);
    part = {lane_sum(count, [&](std::size_t i) { return errors[i]; }), 0};
    part[1] = lane_sum(count, [&](std::size_t i) { return errors[i] <= threshold_ ? errors[i] : 0.0; });
    if (trimmed_ > 0)
      std::copy_if(errors, errors + count, std::back_inserter(part), [&](double e) { return e > threshold_; });
    if (maps.error) write_map(tile, errors, maps.error);
  }

  void add(const Part& part) override {
    sum_.add(part[0]);
    if (trimmed_ == 0) return;
    kept_sum_.add(part[1]);
    worst_.insert(worst_.end(), part.begin() + 2, part.end());
  }

  /// The threshold changes only between bands of rows, so the tiles of a band use the same one on any thread.
  void rows_done(int, const ParallelLoop&) override {
    if (worst_.size() >= 2 * trimmed_ + 4096) keep_the_worst();
  }

  std::optional<double> value(std::size_t which) const override {
    if (which == 0 || trimmed_ == 0) return sum_.value() / static_cast<double>(pixels_);
    RelmsePass all = *this;
    all.keep_the_worst();
    return all.kept_sum_.value() / static_cast<double>(pixels_ - trimmed_);
  }

 private:
  using Values = std::span<const float>;
  static void write_errors(Values r0, Values x0, Values r1, Values x1, Values r2, Values x2, double* errors) {
    const auto of = [](float r, float x) {
      const auto reference = static_cast<double>(r);
      const double difference = static_cast<double>(x) - reference;
      return difference * difference / (reference * reference + kEpsilon);
    };
    for (std::size_t i = 0; i < r0.size(); ++i)
      errors[i] = (of(r0[i], x0[i]) + of(r1[i], x1[i]) + of(r2[i], x2[i])) / 3;
  }

  /// Pixels that do not count stay 0.
  static void write_map(const PairTile& tile, const double* errors, float* map) {
    for (int y = 0; y < tile.height(); ++y)
      for (int x = 0; x < tile.width(); ++x) *map++ = tile.counts(x, y) ? static_cast<float>(*errors++) : 0.0f;
  }

  /// Keeps the `trimmed_` largest errors in worst_ and adds the others to the sum, in the order of their arrival.
  void keep_the_worst() {
    if (worst_.size() <= trimmed_) return;
    const std::size_t going = worst_.size() - trimmed_;
    std::vector<double> ranked = worst_;
    std::nth_element(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(going - 1), ranked.end());
    threshold_ = ranked[going - 1];
    // Some errors equal to the threshold may have to stay.
    auto ties = static_cast<std::uint64_t>(std::count(worst_.begin(), worst_.end(), threshold_)) +
                static_cast<std::uint64_t>(
                    std::count_if(worst_.begin(), worst_.end(), [&](double e) { return e > threshold_; })) -
                trimmed_;
    std::erase_if(worst_, [&](double error) {
      const bool goes = error < threshold_ || (error == threshold_ && ties > 0);
      if (!goes) return false;
      if (error == threshold_) --ties;
      kept_sum_.add(error);
      return true;
    });
  }

  std::uint64_t pixels_, trimmed_;
  ExactSum sum_, kept_sum_;
  std::vector<double> worst_;
  double threshold_ = -1;  // below every error: all may be among the worst
};

}  // namespace

std::unique_ptr<MetricPass> relmse_pass(const PairFacts& pair) { return std::make_unique<RelmsePass>(pair); }
std::string relmse_parameters() { return "epsilon=0.01"; }
std::string relmse_trimmed_parameters() { return "epsilon=0.01, trimmed=0.1% of pixels"; }

}  // namespace photonproof::inline harness_metrics
