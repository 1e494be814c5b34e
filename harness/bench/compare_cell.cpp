#include "harness/bench/compare_cell.h"

#include "harness/metrics/heatmap.h"
#include "scenes/base/input_error.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_bench {
namespace {

constexpr const char* not_compared = "not compared: ";

// The reason why there is no reference to compare with; empty when there is one.
std::string reference_problem(const Result* reference) {
  if (reference == nullptr) return "the reference has not been rendered yet";
  if (reference->status == Status::ok) return {};
  return "the reference " + reference->cell.label() + " ended as " + to_string(reference->status) + " (" +
         reference->detail + ")";
}

std::optional<Image> image_of(const CellComparison& comparison, const Result& result) try {
  return read_stored((comparison.results_folder / result.image).string()).mean;
} catch (const InputError&) {
  return std::nullopt;
}

}  // namespace

void compare_cell(const CellComparison& comparison, Result& result) {
  std::erase_if(result.caveats, [](const std::string& caveat) { return caveat.starts_with(not_compared); });
  result.metrics.clear();
  result.pictures.clear();
  const std::optional<Image> found = image_of(comparison, result);
  if (!found) {
    result.status = Status::bad_image;
    result.detail = "its image could not be read any more when it was to be compared";
    return;
  }
  const Image& image = *found;
  const std::string picture = comparison.cell_folder + "/image.png";
  write_png((comparison.results_folder / picture).string(), image, comparison.exposure);
  result.pictures["image"] = picture;

  const std::string problem = reference_problem(comparison.reference);
  if (!problem.empty()) {
    result.caveats.push_back(not_compared + problem);
    return;
  }
  if (comparison.reference->cell.label() == result.cell.label()) return;
  const std::optional<Image> reference = image_of(comparison, *comparison.reference);
  if (!reference) {
    result.caveats.push_back(not_compared + ("the reference " + comparison.reference->image + " cannot be read"));
    return;
  }
  HeatmapWriter maps(image.width, image.height, comparison.results_folder / comparison.cell_folder, "map");
  ImageRowSource reference_rows(*reference), image_rows(image);
  MetricOptions metrics{.parameters = {comparison.exposure, comparison.hdr_exposures}};
  if (comparison.hdr_exposures) metrics.also = {"hdr_flip"};
  PairMeasurements measured = measure_pair(reference_rows, image_rows, metrics, &maps);
  if (!measured.defects.empty()) {
    result.caveats.push_back(not_compared + measured.defects.front().sentence);
    return;
  }
  result.metrics = finite_values(std::move(measured.measurements));
  const HeatmapFiles files = maps.finish();
  result.pictures["flip"] = comparison.cell_folder + "/" + files.flip.filename().string();
  result.pictures["error"] = comparison.cell_folder + "/" + files.error.filename().string();
}

}  // namespace photonproof::inline harness_bench
