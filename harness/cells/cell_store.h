// The folders of measured cells under a results folder: cells/<key>-<n>/ holds the image, the engine's stats and
// output, and, written last, cell.json. A folder without cell.json was interrupted and holds no result. A cell that is
// measured again gets the next n; nothing is overwritten.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/record/results.h"

namespace photonproof::inline harness_cells {

class CellStore {
 public:
  /// The results folder, which exists; the store is made inside it on first use.
  explicit CellStore(std::filesystem::path results_folder) : folder_(std::move(results_folder)) {}

  struct Found {
    KeptResult kept;
    std::string cell_folder;  ///< relative to the results folder
  };
  /// The latest result of the key. One whose cell.json cannot be read, or whose image is gone or another than was
  /// measured, does not count, and is never touched either; one whose pictures are gone has to be compared again (no
  /// comparison_key).
  std::optional<Found> latest(const std::string& key) const;

  /// An empty folder for a new measurement, relative to the results folder.
  std::string make_folder(const std::string& key) const;

  /// Completes a folder, or replaces its record after a new comparison.
  void keep(const std::string& cell_folder, const KeptResult& kept) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace photonproof::inline harness_cells
