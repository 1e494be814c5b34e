#include <nanobind/stl/array.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "harness/metrics/heatmap.h"
#include "harness/metrics/metric_bounds.h"
#include "harness/metrics/metric_run.h"
#include "harness/python/arrays.h"
#include "harness/python/bindings.h"
#include "scenes/base/input_error.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

using MaskArray = nb::ndarray<const bool, nb::shape<-1, -1>, nb::c_contig, nb::device::cpu>;

std::shared_ptr<const PixelMask> mask_of(const MaskArray& chosen) {
  const auto width = static_cast<int>(chosen.shape(1)), height = static_cast<int>(chosen.shape(0));
  auto mask = std::make_shared<PixelMask>(width, height);
  const bool* at = chosen.data();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (*at++) mask->set(x, y);
  if (mask->counted() == 0) throw InputError("mask", "chooses no pixel: all of them are False");
  return mask;
}

/// Throws InputError, naming the parameter, for numbers out of its range.
void set(const char* name, const std::vector<double>& numbers, ParameterValues& values) {
  for (const MetricParameter& parameter : metric_parameters)
    if (std::string(name) == parameter.name)
      if (const auto reason = set_parameter(parameter, numbers, values)) throw InputError(name, *reason);
}

/// A pair that fits one tile runs on the calling thread alone: the same numbers, without a pool of threads.
int threads_for(const Pixels& pixels, int threads) {
  const bool one_tile = pixels.shape(0) <= TileGrid::tile_height && pixels.shape(1) <= TileGrid::tile_width;
  return threads == 0 && one_tile ? 1 : threads;
}

/// A tuple a metric: name, value or None, parameters, and why it is undefined or None. Throws InputError where the
/// images cannot be compared.
Rows measure_arrays(const Pixels& reference, const Pixels& test, std::vector<std::string> metrics, double exposure,
                    const std::optional<std::vector<double>>& exposures, double more_than,
                    const std::optional<std::array<int, 4>>& region, const std::optional<MaskArray>& mask,
                    int threads) {
  if (threads < 0 || threads > 1024) throw InputError("threads", "must be from 0, every core, to 1024");
  MetricOptions options;
  set("exposure", {exposure}, options.parameters);
  set("more_than", {more_than}, options.parameters);
  if (exposures) set("exposures", *exposures, options.parameters);
  for (const std::string& name : metrics) metric_named("metrics", name);
  options.only = std::move(metrics);
  if (region) options.region = PixelRegion{(*region)[0], (*region)[1], (*region)[2], (*region)[3]};
  if (mask) {
    options.mask = mask_of(*mask);
    options.mask_name = "mask";
  }
  options.threads = threads_for(reference, threads);
  PairMeasurements measured;
  {
    const nb::gil_scoped_release released;
    ArrayRows reference_rows(reference), test_rows(test);
    measured = measure_pair(reference_rows, test_rows, options);
  }
  if (!measured.defects.empty()) throw InputError("images", measured.defects.front().sentence);
  nb::list result;
  for (const Measurement& metric : measured.measurements)
    result.append(nb::make_tuple(metric.row->name, metric.value, metric.parameters,
                                 metric.value ? nullptr : metric.row->undefined_when));
  return result;
}

/// A tuple a metric: name, the meaning of its bound, and whether it is computed only on request.
Rows metric_table() {
  constexpr const char* bounds[] = {"maximum", "minimum", "absolute maximum"};
  nb::list rows;
  for (const MetricRow& row : metric_rows())
    rows.append(nb::make_tuple(row.name, bounds[static_cast<int>(row.bound)], row.on_request));
  return rows;
}

/// The reason why a bound on a metric's value is broken, or None.
std::optional<std::string> broken(const std::string& metric, double value, double bound) {
  const std::vector<Measurement> measured{{&metric_named("metric", metric), value, ""}};
  return broken_bound({measured.front().row, bound}, measured);
}

/// The heat maps of `compare --heatmap`: STEM-flip.png and STEM-error.png in the folder.
void write_heatmaps(const Pixels& reference, const Pixels& test, double exposure, const std::string& folder,
                    const std::string& stem) {
  const nb::gil_scoped_release released;
  MetricOptions options;
  set("exposure", {exposure}, options.parameters);
  options.only = {"flip"};
  ArrayRows reference_rows(reference), test_rows(test);
  HeatmapWriter maps(reference_rows.width(), reference_rows.height(), folder, stem);
  const PairMeasurements measured = measure_pair(reference_rows, test_rows, options, &maps);
  if (!measured.defects.empty()) throw InputError("images", measured.defects.front().sentence);
  maps.finish();
}

}  // namespace

void bind_metrics(nb::module_& module) {
  using namespace nb::literals;
  module.def("measure", &measure_arrays, "reference"_a, "test"_a, "metrics"_a, "exposure"_a, "exposures"_a.none(),
             "more_than"_a, "region"_a.none(), "mask"_a.none(), "threads"_a);
  module.def("metric_table", &metric_table);
  module.def("write_heatmaps", &write_heatmaps, "reference"_a, "test"_a, "exposure"_a, "folder"_a, "stem"_a);
  module.def("broken_bound", &broken, "metric"_a, "value"_a, "bound"_a);
}

}  // namespace photonproof::inline harness_python
