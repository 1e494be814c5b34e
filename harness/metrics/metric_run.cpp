#include "harness/metrics/metric_run.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/base/thread_handoff.h"

namespace photonproof::inline harness_metrics {
namespace {

/// Loops on a number of threads, each with its own tile memory.
class Workers {
 public:
  explicit Workers(int threads)
      : count_(threads > 0 ? threads : tbb::this_task_arena::max_concurrency()),
        limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)),
        arena_(count_) {}

  void for_each(std::size_t n, const TileBody& body) {
    const auto work = [&](std::size_t i) PHOTONPROOF_CALLED_BY_LIBRARY {
      takes_over(&arena_);
      body(i, memories_.local());
      hands_over(&memories_);
    };
    hands_over(&arena_);
    arena_.execute([&] { tbb::parallel_for(std::size_t{0}, n, work, tbb::simple_partitioner()); });
    takes_over(&memories_);
  }

 private:
  int count_;
  tbb::global_control limit_;
  tbb::task_arena arena_;
  tbb::enumerable_thread_specific<TileMemory> memories_;
};

/// The values of an image that are not finite.
struct NonFinite {
  std::size_t count = 0;
  int x = 0, y = 0;
  std::size_t channel = 0;
  float value = 0;  ///< the first one; x, y and channel are its place

  void find(const float* rgb, int width, int first_row, int end_row) {
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    for (int at = first_row; at < end_row; ++at, rgb += row) {
      // v - v is 0 only for finite values; the sum of a row shows whether to look closer.
      float sum = 0;
      float lanes[16] = {};
      std::size_t i = 0;
      for (; i + 16 <= row; i += 16)
        for (std::size_t k = 0; k < 16; ++k) lanes[k] += rgb[i + k] - rgb[i + k];
      for (; i < row; ++i) sum += rgb[i] - rgb[i];
      for (const float lane : lanes) sum += lane;
      if (sum == 0) continue;
      for (i = 0; i < row; ++i) {
        if (std::isfinite(rgb[i])) continue;
        if (count++ == 0) *this = {count, static_cast<int>(i / 3), at, i % 3, rgb[i]};
      }
    }
  }

  /// Adds the count of rows below these.
  void add(const NonFinite& below) {
    const std::size_t all = count + below.count;
    if (count == 0) *this = below;
    count = all;
  }

  void report(const std::string& name, std::vector<ImageDefect>& defects) const {
    if (count == 0) return;
    const std::string what = std::isnan(value) ? "NaN" : value > 0 ? "+infinity" : "-infinity";
    defects.push_back({ImageDefect::Kind::non_finite,
                       "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") of the " + name + " image is " +
                           what + " in " + "RGB"[channel] + "; " + std::to_string(count) + " non-finite in all"});
  }
};

/// Consecutive rows of a source: a band and the rows that its tiles need around it. An image in memory is not copied.
class RowWindow {
 public:
  explicit RowWindow(RowSource& source) : source_(source) {}

  /// Drops the rows above `begin`, then reads on to `end`.
  void move(int begin, int end, Workers& workers) {
    const std::size_t row = 3 * static_cast<std::size_t>(source_.width());
    const int from = std::max(begin, end_);
    if (!source_.in_memory()) {
      const auto dropped = static_cast<std::size_t>(begin - first_) * row;
      rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(dropped));
      first_ = begin;
      rows_.resize(static_cast<std::size_t>(end - begin) * row);
      source_.read(from, end, rows_.data() + static_cast<std::size_t>(from - begin) * row);
    }
    find_non_finite(from, end, workers);
    end_ = end;
  }
  RowBlock block() const { return {source_.in_memory() ? source_.in_memory() : rows_.data(), first_}; }
  const NonFinite& non_finite() const { return non_finite_; }

 private:
  void find_non_finite(int begin, int end, Workers& workers) {
    constexpr int at_once = 32;  // rows
    std::vector<NonFinite> found(static_cast<std::size_t>((end - begin + at_once - 1) / at_once));
    const RowBlock rows = block();
    workers.for_each(found.size(), [&](std::size_t i, TileMemory&) {
      const int first = begin + static_cast<int>(i) * at_once;
      const float* rgb = rows.rgb + 3 * static_cast<std::ptrdiff_t>(source_.width()) * (first - rows.first);
      found[i].find(rgb, source_.width(), first, std::min(end, first + at_once));
    });
    for (const NonFinite& below : found) non_finite_.add(below);
  }

  RowSource& source_;
  std::vector<float> rows_;
  int first_ = 0, end_ = 0;
  NonFinite non_finite_;
};

/// The number of rows that are read and measured together: whole rows of tiles of about two million pixels. It depends
/// only on the width, so that nothing else affects a result.
int band_height(int width) {
  const int rows = (1 << 21) / width / TileGrid::tile_height * TileGrid::tile_height;
  return std::clamp(rows, TileGrid::tile_height, 8 * TileGrid::tile_height);
}

class Run {
 public:
  Run(RowSource& reference, RowSource& test, const MetricOptions& options, MapSink* maps)
      : workers_(options.threads),
        reference_(reference),
        test_(test),
        grid_{reference.width(), reference.height()},
        options_(options),
        maps_(maps) {
    const PairFacts pair = facts();
    for (const MetricRow& row : metric_rows()) {
      const bool wanted = is_wanted(row, options_), shown = maps && (row.pass == flip_pass || row.pass == relmse_pass);
      if (wanted) rows_.push_back(&row);
      if (!(wanted || shown) || std::ranges::find(makers_, row.pass) != makers_.end()) continue;
      makers_.push_back(row.pass);
      passes_.push_back(row.pass(pair));
    }
  }

  void measure_all() {
    for (int y = 0, end = 0; y < grid_.height; y = end) {
      end = std::min(grid_.height, y + band_height(grid_.width));
      const int begin = std::max(0, y - PairTile::reach), last = std::min(grid_.height, end + PairTile::reach);
      reference_.move(begin, last, workers_);
      test_.move(begin, last, workers_);
      // Metrics never get an image with non-finite values; the other rows are read only to count these.
      if (reference_.non_finite().count + test_.non_finite().count == 0) measure_band(y, end);
    }
  }

  std::vector<ImageDefect> defects() const {
    std::vector<ImageDefect> found;
    reference_.non_finite().report("reference", found);
    test_.non_finite().report("test", found);
    return found;
  }

  std::vector<Measurement> measurements() const {
    std::string notes;
    if (options_.region) notes += ", region=" + options_.region->text();
    if (options_.mask) notes += ", mask=" + options_.mask_name;
    std::vector<Measurement> measured;
    for (const MetricRow* row : rows_) {
      const auto pass = static_cast<std::size_t>(std::ranges::find(makers_, row->pass) - makers_.begin());
      std::string parameters = parameters_text(*row, options_.parameters);
      parameters += parameters.empty() && !notes.empty() ? notes.substr(2) : notes;
      measured.push_back({row, passes_[pass]->value(row->which), std::move(parameters)});
    }
    return measured;
  }

 private:
  PairFacts facts() const {
    PairFacts pair{grid_.width, grid_.height, 0, options_.mask != nullptr, options_};
    pair.counted = options_.mask ? options_.mask->counted()
                                 : static_cast<std::uint64_t>(grid_.width) * static_cast<std::uint64_t>(grid_.height);
    return pair;
  }

  void measure_band(int begin, int end) {
    const int across = grid_.across();
    const int down = (end - begin + TileGrid::tile_height - 1) / TileGrid::tile_height;
    const std::size_t tiles = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
    const auto width = static_cast<std::size_t>(grid_.width);
    if (maps_)
      for (auto* map : {&flip_, &error_}) map->resize(static_cast<std::size_t>(end - begin) * width);
    std::vector<std::vector<MetricPass::Part>> parts(tiles, std::vector<MetricPass::Part>(passes_.size()));

    for (const auto& pass : passes_) pass->rows_begin(begin, end);
    workers_.for_each(tiles, [&](std::size_t i, TileMemory& memory) {
      const int x0 = static_cast<int>(i) % across * TileGrid::tile_width;
      const int y0 = begin + static_cast<int>(i) / across * TileGrid::tile_height;
      const PairTile tile(grid_, x0, y0, reference_.block(), test_.block(), options_.mask.get(),
                          options_.parameters.exposure, memory);
      TileMaps tile_maps;
      if (maps_) tile_maps = {memory.take<float>(tile.pixels()), memory.take<float>(tile.pixels())};
      for (std::size_t p = 0; p < passes_.size(); ++p) passes_[p]->measure(tile, tile_maps, parts[i][p]);
      if (!maps_) return;
      const auto row = static_cast<std::size_t>(tile.width());
      for (std::size_t y = 0; y < static_cast<std::size_t>(tile.height()); ++y) {
        const std::size_t to = (static_cast<std::size_t>(y0 - begin) + y) * width + static_cast<std::size_t>(x0);
        std::copy_n(tile_maps.flip + y * row, row, flip_.data() + to);
        std::copy_n(tile_maps.error + y * row, row, error_.data() + to);
      }
    });
    for (const auto& tile : parts)
      for (std::size_t p = 0; p < passes_.size(); ++p) passes_[p]->add(tile[p]);
    const ParallelLoop loop = [&](std::size_t n, const TileBody& body) { workers_.for_each(n, body); };
    for (const auto& pass : passes_) pass->rows_done(end, loop);
    if (maps_) maps_->add(end - begin, flip_.data(), error_.data());
  }

  Workers workers_;
  RowWindow reference_, test_;
  TileGrid grid_;
  MetricOptions options_;
  MapSink* maps_;
  std::vector<const MetricRow*> rows_;
  std::vector<decltype(MetricRow::pass)> makers_;
  std::vector<std::unique_ptr<MetricPass>> passes_;
  std::vector<float> flip_, error_;  // the band's maps
};

std::vector<ImageDefect> size_defects(int width, int height, int test_width, int test_height) {
  using enum ImageDefect::Kind;
  if (width != test_width || height != test_height)
    return {{size_mismatch, "the test image is " + size_text(test_width, test_height) +
                                " pixels, the reference image " + size_text(width, height)}};
  if (width == 0 || height == 0) return {{size_mismatch, "the images have no pixels"}};
  return {};
}

PairMeasurements measure_part(RowSource& reference, RowSource& test, MetricOptions options, MapSink* maps) {
  if (options.mask && (options.mask->width() != reference.width() || options.mask->height() != reference.height()))
    throw InputError(options.mask_name, "mask is " + size_text(options.mask->width(), options.mask->height()) +
                                            " pixels, what it should choose from " +
                                            size_text(reference.width(), reference.height()));
  for (const MetricRow& row : metric_rows())
    if (row.derive && is_wanted(row, options)) row.derive(options.parameters, reference);
  Run run(reference, test, options, maps);
  run.measure_all();
  PairMeasurements result{run.defects(), {}, reference.width(), reference.height()};
  if (result.defects.empty()) result.measurements = run.measurements();
  return result;
}

}  // namespace

PairMeasurements measure_pair(RowSource& reference, RowSource& test, const MetricOptions& options, MapSink* maps) {
  auto mismatch = size_defects(reference.width(), reference.height(), test.width(), test.height());
  if (!mismatch.empty()) return {std::move(mismatch), {}, reference.width(), reference.height()};
  if (!options.region) return measure_part(reference, test, options, maps);
  RegionSource reference_part(reference, *options.region), test_part(test, *options.region);
  return measure_part(reference_part, test_part, options, maps);
}

std::vector<Measurement> measure(const Image& reference, const Image& test, const MetricOptions& options,
                                 MapSink* maps) {
  ImageRowSource reference_rows(reference), test_rows(test);
  return measure_pair(reference_rows, test_rows, options, maps).measurements;
}

std::vector<ImageDefect> find_defects(const Image& reference, const Image& test) {
  auto defects = size_defects(reference.width, reference.height, test.width, test.height);
  if (!defects.empty()) return defects;
  for (const auto& [image, name] : {std::pair{&reference, "reference"}, {&test, "test"}}) {
    NonFinite values;
    values.find(image->rgb.data(), image->width, 0, image->height);
    values.report(name, defects);
  }
  return defects;
}

std::vector<MetricValue> finite_values(std::vector<Measurement> measurements) {
  std::vector<MetricValue> values;
  for (Measurement& measured : measurements)
    if (measured.value && std::isfinite(*measured.value))
      values.push_back({measured.row->name, *measured.value, std::move(measured.parameters)});
  return values;
}

}  // namespace photonproof::inline harness_metrics
