// Runs the metrics over a pair of images: bands of rows are read, cut into tiles, and measured on all threads. What is
// in memory at any time is a band, whatever the images' size.
#pragma once

#include <vector>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/row_source.h"

namespace photonproof::inline harness_metrics {

/// Takes the maps behind the heat maps row after row.
class MapSink {
 public:
  virtual ~MapSink() = default;
  /// The next rows, of the images' width.
  virtual void add(int rows, const float* flip, const float* error) = 0;
};

struct PairMeasurements {
  std::vector<ImageDefect> defects;       ///< when there are any, no metric was computed
  std::vector<Measurement> measurements;  ///< one for each row of the table that was asked for
  int width = 0, height = 0;              ///< of the reference, or of the region
};

/// `maps` may be null. The result has the same bits at any number of threads. Throws InputError when a source cannot be
/// read, the region is no part of an image, or the mask's size is another.
PairMeasurements measure_pair(RowSource& reference, RowSource& test, const MetricOptions& options,
                              MapSink* maps = nullptr);

/// The same of images in memory. Precondition: find_defects is empty.
std::vector<Measurement> measure(const Image& reference, const Image& test, const MetricOptions& options,
                                 MapSink* maps = nullptr);

/// Those that have a finite value.
std::vector<MetricValue> finite_values(std::vector<Measurement> measurements);

}  // namespace photonproof::inline harness_metrics
