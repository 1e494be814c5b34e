// Runs the metrics over a pair of images: bands of rows are read, cut into tiles, and measured on all threads. Memory
// holds one band at a time, for any image size.
#pragma once

#include <vector>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/row_source.h"

namespace photonproof::inline harness_metrics {

/// Receives the maps behind the heat maps, row after row.
class MapSink {
 public:
  virtual ~MapSink() = default;
  /// Adds the next rows, of the images' width.
  virtual void add(int rows, const float* flip, const float* error) = 0;
};

struct PairMeasurements {
  std::vector<ImageDefect> defects;       ///< if there are any, no metric was computed
  std::vector<Measurement> measurements;  ///< one for each requested row of the table
  int width = 0, height = 0;              ///< size of the reference, or of the region
};

/// `maps` may be null. The result has the same bits at any number of threads. Throws InputError when a source cannot be
/// read, the region is not inside an image, or the mask has another size.
PairMeasurements measure_pair(RowSource& reference, RowSource& test, const MetricOptions& options,
                              MapSink* maps = nullptr);

/// The same for images in memory. Precondition: find_defects is empty.
std::vector<Measurement> measure(const Image& reference, const Image& test, const MetricOptions& options,
                                 MapSink* maps = nullptr);

/// The measurements with a finite value.
std::vector<MetricValue> finite_values(std::vector<Measurement> measurements);

}  // namespace photonproof::inline harness_metrics
