#include "harness/metrics/heatmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include "reports/record/heatmap_magma.h"
#include "scenes/base/input_error.h"
#include "scenes/base/thread_handoff.h"

namespace photonproof::inline harness_metrics {
namespace {

/// `position` is the value's place on its scale, clamped to [0,1] here.
std::uint8_t shade(float position) { return static_cast<std::uint8_t>(255 * std::clamp(position, 0.0f, 1.0f) + 0.5f); }

void write_rows(PngRows& file, int rows, std::size_t width, const float* values, std::uint8_t (*shade_of)(float)) {
  const std::size_t pixels = width * static_cast<std::size_t>(rows);
  std::vector<std::uint8_t> bytes(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t colour = magma_colours[shade_of(values[i])];
    for (std::size_t c = 0; c < 3; ++c) bytes[3 * i + c] = static_cast<std::uint8_t>(colour >> (16 - 8 * c));
  }
  file.add(rows, bytes.data());
}

const std::filesystem::path& made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "folder cannot be made: " + error.message());
  return folder;
}

}  // namespace

std::uint8_t flip_shade(float flip) { return shade(flip); }

std::uint8_t error_shade(float relative_squared_error) {
  static const float scale = 1 / std::log(static_cast<float>(error_scale_greatest / error_scale_least));
  // log(0) is -infinity, which the clamp takes to the dark end.
  return shade(std::log(relative_squared_error / static_cast<float>(error_scale_least)) * scale);
}

HeatmapFiles heatmap_files(const std::filesystem::path& folder, const std::string& stem) {
  return {folder / (stem + "-flip.png"), folder / (stem + "-error.png")};
}

HeatmapWriter::HeatmapWriter(int width, int height, const std::filesystem::path& folder, const std::string& stem)
    : width_(static_cast<std::size_t>(width)),
      files_(heatmap_files(made(folder), stem)),
      flip_(files_.flip.string(), width, height),
      error_(files_.error.string(), width, height) {}

void HeatmapWriter::add(int rows, const float* flip, const float* error) {
  const auto write = [&](int which) PHOTONPROOF_CALLED_BY_LIBRARY {
    takes_over(this);
    if (which == 0)
      write_rows(flip_, rows, width_, flip, flip_shade);
    else
      write_rows(error_, rows, width_, error, error_shade);
    hands_over(&files_);
  };
  hands_over(this);
  tbb::parallel_for(0, 2, write, tbb::simple_partitioner());
  takes_over(&files_);
}

HeatmapFiles HeatmapWriter::finish() {
  flip_.finish();
  error_.finish();
  return files_;
}

}  // namespace photonproof::inline harness_metrics
