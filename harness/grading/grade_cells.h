// Runs of programs that have ended, each a folder under cells/ with its image and, written last, cell.json: what a
// killed grading leaves is whole but for the run it was at. Nothing is overwritten: a run that is made again gets a
// folder of its own.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "reports/grades/grade_record.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_grading {

class GradeCells {
 public:
  /// The folder of grades.json, which exists and is locked by the caller.
  explicit GradeCells(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Cell {
    GradedRun run;
    std::optional<Image> image;
  };
  /// The latest run of the key; empty where there is none, or it is damaged. May be called on several threads.
  std::optional<Cell> find(const std::string& key) const;

  /// Keeps a run and its image; sets run.image. May be called on several threads.
  void keep(const std::string& key, Cell& cell);

 private:
  std::filesystem::path folder_;
  std::mutex making_;
};

}  // namespace photonproof::inline harness_grading
