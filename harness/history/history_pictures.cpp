#include "harness/history/history_pictures.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "harness/history/history_values.h"
#include "harness/metrics/heatmap.h"
#include "harness/metrics/metric_run.h"
#include "harness/metrics/metrics.h"
#include "reports/page/picture.h"
#include "reports/view/view.h"
#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_history {
namespace {

namespace fs = std::filesystem;
using reports::PictureChange;
using CellName = std::tuple<std::string, std::string, std::string, std::uint64_t>;

void add_picture(const fs::path& folder, const std::string& file, HistoryPicture picture,
                 std::vector<HistoryPicture>& pictures) {
  reports::PictureBytes read = reports::read_thumbnail(folder, file, largest_kept);
  if (!read.problem.empty()) return;
  Checksum checksum;
  checksum.add(read.bytes.data(), read.bytes.size());
  picture.checksum = checksum.hex();
  picture.png = std::move(read.bytes);
  pictures.push_back(std::move(picture));
}

/// Writes the difference and sets its FLIP, or the reason why there is none.
void measure_difference(const fs::path& folder, PictureChange& change) {
  const Image old_image = read_image((folder / change.old_file).string());
  const Image new_image = read_image((folder / change.new_file).string());
  if (old_image.width != new_image.width || old_image.height != new_image.height) {
    change.problem =
        size_text(old_image.width, old_image.height) + " became " + size_text(new_image.width, new_image.height);
    change.flip = 1;
    return;
  }
  const std::string stem = change.old_file.substr(0, change.old_file.find('-'));
  HeatmapWriter maps(old_image.width, old_image.height, folder, stem);
  for (const MetricValue& value : finite_values(measure(old_image, new_image, {.only = {"flip"}}, &maps)))
    if (value.name == "flip") change.flip = value.value;
  change.difference_file = maps.finish().flip.filename().string();
}

/// The change of two pictures, in files of the scratch folder that begin with `stem`.
PictureChange change_of(const HistoryPicture& before, const HistoryPicture& after, const fs::path& folder,
                        const std::string& stem) {
  PictureChange change;
  change.scene = after.scene;
  change.engine = after.engine;
  change.budget = after.budget;
  change.old_file = stem + "-old.png";
  change.new_file = stem + "-new.png";
  write_file_atomically(folder / change.old_file, before.png);
  write_file_atomically(folder / change.new_file, after.png);
  try {
    measure_difference(folder, change);
  } catch (const InputError& error) {
    change.problem = "the pictures cannot be compared: " + error.message();
  }
  return change;
}

/// Copies a file under the name that comments use, and returns that name with its folder's.
std::string publish(const fs::path& from, const fs::path& folder, const std::string& name) {
  write_file_atomically(folder / name, read_file(from));
  return (folder.filename() / name).string();
}

}  // namespace

std::vector<HistoryPicture> pictures_of(const Results& results, const fs::path& folder) {
  std::map<std::tuple<std::string, std::string, std::string>, const Result*> first;
  for (const Result* result : measured_cells(results)) {
    if (!result->pictures.contains("image")) continue;
    const Result*& kept = first[{result->cell.scene, result->cell.engine, result->cell.budget.label()}];
    if (kept == nullptr || result->cell.seed < kept->cell.seed) kept = result;
  }
  std::vector<HistoryPicture> pictures;
  for (const auto& [names, result] : first)
    add_picture(
        folder, result->pictures.at("image"),
        {result->cell.scene, result->cell.engine, reports::budget_text(result->cell.budget), result->cell.seed, {}, {}},
        pictures);
  for (const GateRecord& gate : results.gates)
    if (gate.pictures.contains("image"))
      add_picture(folder, gate.pictures.at("image"), {gate.scene, gate.engine, "gate " + gate.name, 0, {}, {}},
                  pictures);
  return pictures;
}

void compare_pictures(const std::vector<HistoryPicture>& base, const std::vector<HistoryPicture>& head,
                      const fs::path& folder, std::size_t most, reports::HistoryComparison& comparison) {
  std::map<CellName, const HistoryPicture*> before;
  for (const HistoryPicture& picture : base)
    before[{picture.scene, picture.engine, picture.budget, picture.seed}] = &picture;
  const ScratchFolder scratch("history");
  for (const HistoryPicture& picture : head) {
    const auto found = before.find({picture.scene, picture.engine, picture.budget, picture.seed});
    if (found == before.end()) continue;
    ++comparison.pictures_compared;
    if (found->second->checksum == picture.checksum) continue;
    ++comparison.pictures_changed;
    comparison.pictures.push_back(
        change_of(*found->second, picture, scratch.path(), std::to_string(comparison.pictures_changed)));
  }
  std::ranges::stable_sort(comparison.pictures, std::ranges::greater(), &PictureChange::flip);
  if (comparison.pictures.size() > most) comparison.pictures.resize(most);
  if (comparison.pictures.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
  std::size_t number = 0;
  for (PictureChange& change : comparison.pictures) {
    const std::string stem = std::to_string(++number);
    change.old_file = publish(scratch.path() / change.old_file, folder, stem + "-old.png");
    change.new_file = publish(scratch.path() / change.new_file, folder, stem + "-new.png");
    if (!change.difference_file.empty())
      change.difference_file = publish(scratch.path() / change.difference_file, folder, stem + "-difference.png");
  }
}

}  // namespace photonproof::inline harness_history
