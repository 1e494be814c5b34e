#include "harness/cells/cell_store.h"

#include "reports/record/file_inside.h"
#include "scenes/base/input_error.h"
#include "scenes/files/file_checksum.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const std::string& key, int n) { return "cells/" + key + "-" + std::to_string(n); }

// False also for what cannot be looked at.
bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// Whether the image is still the one that was measured. Of a record without its checksum only that it is an image.
bool has_its_image(const fs::path& results_folder, const Result& result) {
  const fs::path image = results_folder / result.image;
  if (result.image.empty()) return true;
  if (!result.image_checksum.empty()) return file_checksum(image) == result.image_checksum;
  if (!is_there(image)) return false;
  if (result.status != Status::ok) return true;
  try {
    read_image(image.string());
    return true;
  } catch (const InputError&) {
    return false;
  }
}

int last_number(const fs::path& results_folder, const std::string& key) {
  int n = 0;
  while (is_there(results_folder / folder_name(key, n + 1))) ++n;
  return n;
}

}  // namespace

std::optional<CellStore::Found> CellStore::latest(const std::string& key) const {
  for (int n = last_number(folder_, key); n > 0; --n) {
    const std::string name = folder_name(key, n);
    const fs::path record = folder_ / name / "cell.json";
    if (!is_there(record)) continue;
    try {
      Found found{read_result(record.string()), name};
      const Result& result = found.kept.result;
      refuse_link_outside(folder_, result.image);
      refuse_links_outside(folder_, result.pictures);
      if (!has_its_image(folder_, result)) continue;
      for (const auto& [role, picture] : result.pictures)
        if (!is_there(folder_ / picture)) found.kept.comparison_key.clear();
      return found;
    } catch (const InputError&) {
      // Of another version, or damaged: the same to us as never measured.
    }
  }
  return std::nullopt;
}

std::string CellStore::make_folder(const std::string& key) const {
  const int n = last_number(folder_, key);
  const bool is_leftover = n > 0 && !is_there(folder_ / folder_name(key, n) / "cell.json");
  std::string name = folder_name(key, is_leftover ? n : n + 1);
  std::error_code error;
  if (is_leftover) fs::remove_all(folder_ / name, error);
  if (!error) fs::create_directories(folder_ / name, error);
  if (error) throw InputError((folder_ / name).string(), "cannot be made: " + error.message());
  return name;
}

void CellStore::keep(const std::string& cell_folder, const KeptResult& kept) const {
  write_result((folder_ / cell_folder / "cell.json").string(), kept);
}

}  // namespace photonproof::inline harness_cells
