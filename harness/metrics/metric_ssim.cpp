// Structural similarity (metric_windows.h) on display-encoded values, per channel, then the mean of the three. It
// equals this function of scikit-image:
//   structural_similarity(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1, channel_axis=2).
// Only windows that lie wholly inside the image count, so the treatment of borders does not matter. This is the first
// scale of ms_ssim, which shares the pass.

#include "harness/metrics/metric_ms_ssim.h"
#include "harness/metrics/metric_rows.h"
#include "harness/metrics/metric_windows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

class SsimPass : public SumPass {
 public:
  explicit SsimPass(const PairFacts& pair) : undefined_(pair.width < ssim_window || pair.height < ssim_window) {
    if (is_wanted(*find_metric("ms_ssim"), pair.options) && CoarseScales::possible(pair))
      coarse_.emplace(pair.width, pair.height);
  }

  void rows_begin(int begin, int end) override {
    if (coarse_) coarse_->rows_begin(begin, end);
  }

  /// Sums of the similarity of three channels, of their structure term, and the number of windows.
  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    if (undefined_) return;
    const TileColour r = tile.encoded(0), x = tile.encoded(1);
    part.resize(7);
    const InnerRange columns = inner_range(tile.x0(), tile.width(), tile.image_width());
    const InnerRange rows = inner_range(tile.y0(), tile.height(), tile.image_height());
    for (int y = rows.first; y < rows.end; ++y) part[6] += counted(tile, columns, y);
    for (std::size_t c = 0; c < 3 && columns.first < columns.end; ++c) {
      const TileMemory::Frame frame(tile.memory());
      SimilarityRows similarity(r[c].at(columns.first, rows.first), x[c].at(columns.first, rows.first), columns.count(),
                                tile.memory());
      for (int y = rows.first; y < rows.end; ++y) {
        similarity.next();
        part[c] += sum_counted(tile, similarity.ssim(), columns, y);
        part[3 + c] += sum_counted(tile, similarity.structure(), columns, y);
      }
    }
    if (coarse_) coarse_->put(tile);
  }

  void rows_done(int y, const ParallelLoop& loop) override {
    if (coarse_) coarse_->rows_done(y, loop);
  }

  std::optional<double> value(std::size_t which) const override {
    if (undefined_ || sum(6) == 0) return std::nullopt;
    if (which == 0) return ((sum(0) + sum(1) + sum(2)) / 3) / sum(6);
    if (!coarse_) return std::nullopt;
    return coarse_->ms_ssim({sum(3) / sum(6), sum(4) / sum(6), sum(5) / sum(6)});
  }

 private:
  static double counted(const PairTile& tile, const InnerRange& columns, int y) {
    if (tile.all_count()) return static_cast<double>(columns.count());
    double count = 0;
    for (int x = columns.first; x < columns.end; ++x) count += tile.counts(x, y) ? 1 : 0;
    return count;
  }

  static double sum_counted(const PairTile& tile, const double* row, const InnerRange& columns, int y) {
    if (tile.all_count()) return lane_sum(columns.count(), [&](std::size_t i) { return row[i]; });
    return lane_sum(columns.count(),
                    [&](std::size_t i) { return tile.counts(columns.first + static_cast<int>(i), y) ? row[i] : 0.0; });
  }

  bool undefined_;
  std::optional<CoarseScales> coarse_;
};

}  // namespace

std::unique_ptr<MetricPass> ssim_pass(const PairFacts& pair) { return std::make_unique<SsimPass>(pair); }

std::string ssim_parameters() { return "exposure, window=11, sigma=1.5, K1=0.01, K2=0.03, data_range=1"; }

}  // namespace photonproof::inline harness_metrics
