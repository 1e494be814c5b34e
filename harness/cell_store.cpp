#include "harness/cell_store.h"

#include "scenes/input_error.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const std::string& key, int n) { return "cells/" + key + "-" + std::to_string(n); }

int last_number(const fs::path& results_folder, const std::string& key) {
  int n = 0;
  while (fs::exists(results_folder / folder_name(key, n + 1))) ++n;
  return n;
}

}  // namespace

std::optional<CellStore::Found> CellStore::latest(const std::string& key) const {
  for (int n = last_number(folder_, key); n > 0; --n) {
    const std::string name = folder_name(key, n);
    const fs::path record = folder_ / name / "cell.json";
    if (!fs::exists(record)) continue;
    try {
      Found found{read_result(record.string()), name};
      const Result& result = found.kept.result;
      if (!result.image.empty() && !fs::exists(folder_ / result.image)) continue;
      for (const auto& [role, picture] : result.pictures)
        if (!fs::exists(folder_ / picture)) found.kept.comparison_key.clear();
      return found;
    } catch (const InputError&) {
      // Of another version, or damaged: the same to us as never measured.
    }
  }
  return std::nullopt;
}

std::string CellStore::make_folder(const std::string& key) const {
  const int n = last_number(folder_, key);
  const bool is_leftover = n > 0 && !fs::exists(folder_ / folder_name(key, n) / "cell.json");
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

}  // namespace photonproof
