#include "harness/grading/grade_cells.h"

#include <nlohmann/json.hpp>

#include "reports/grades/grades_json.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

std::string cell_name(const std::string& key, int n) { return "cells/" + key + "-" + std::to_string(n); }

std::string values_checksum(const Image& image) {
  Checksum sum;
  sum.add(image.rgb.data(), image.rgb.size() * sizeof(float));
  return sum.hex();
}

int last_cell(const fs::path& folder, const std::string& key) {
  int n = 0;
  while (fs::exists(folder / cell_name(key, n + 1))) ++n;
  return n;
}

}  // namespace

std::optional<GradeCells::Cell> GradeCells::find(const std::string& key) const {
  for (int n = last_cell(folder_, key); n > 0; --n) {
    const fs::path record = folder_ / cell_name(key, n) / "cell.json";
    if (!fs::exists(record)) continue;
    try {
      Cell cell{run_from_json(nlohmann::ordered_json::parse(read_file(record))), {}};
      if (!cell.run.image.empty()) {
        cell.image = read_image((folder_ / cell.run.image).string());
        if (values_checksum(*cell.image) != cell.run.checksum) continue;
      }
      return cell;
    } catch (const InputError&) {  // damaged: the same to us as never made
    } catch (const nlohmann::json::exception&) {
    }
  }
  return std::nullopt;
}

void GradeCells::keep(const std::string& key, Cell& cell) {
  std::string name;
  {
    const std::lock_guard lock(making_);
    const int n = last_cell(folder_, key);
    name = cell_name(key, n + 1);
    fs::create_directories(folder_ / name);
  }
  if (cell.image) {
    cell.run.image = name + "/image.exr";
    cell.run.checksum = values_checksum(*cell.image);
    write_exr((folder_ / cell.run.image).string(), {.mean = *cell.image, .variance = {}, .metadata = {}});
  }
  write_file_atomically(folder_ / name / "cell.json", json_text(run_to_json(cell.run)));
}

}  // namespace photonproof::inline harness_grading
