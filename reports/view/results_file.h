// Files that results.json names. The names are not trusted: a report shows no file outside its folder.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::reports::inline reports_view {

struct ResultsFile {
  std::filesystem::path path;  ///< canonical; empty when there is a problem
  std::string problem;         ///< one sentence, empty on success
};

/// Finds `relative` inside `folder`. A name that is empty, missing, or leads out of the folder is a problem.
ResultsFile results_file(const std::filesystem::path& folder, const std::string& relative);

}  // namespace photonproof::reports::inline reports_view
