// What a run consists of before anything is measured: every cell with its command, its key and what is known already.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/cells/cell_store.h"
#include "harness/suites/suite.h"
#include "reference/store/reference_store.h"
#include "scenes/description/expect.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_bench {

struct PlannedCell {
  Cell cell;
  bool is_reference = false;
  std::string key{};
  std::optional<std::string> unsupported{};     ///< why the engine cannot render the scene, known without trying
  Status status_untried = Status::unsupported;  ///< its result's, then
  std::optional<CellStore::Found> found{};      ///< its latest result
};

struct BenchPlan {
  std::vector<SceneRecord> scenes;
  std::vector<EngineRecord> engines;              ///< those that a cell uses
  std::vector<PlannedCell> cells;                 ///< references first, then the suite's order
  std::map<std::string, StoredReference> stored;  ///< by scene, of those that the run does not render a reference for
  std::map<std::string, std::optional<Expect>> expectations;  ///< by scene
  std::map<std::string, std::optional<FilmPart>> crops;       ///< by scene, at its size in the suite

  PlannedCell& find(const std::string& label);  ///< precondition: it exists
  const PlannedCell& find(const std::string& label) const;
};

/// Asks the engines for their versions, reads the scenes and their expectations, and looks up what `store` holds.
/// `program` is this program; `host` decides keys too, since a timing holds for one machine. Throws InputError for a
/// scene or expect.toml that cannot be read, and for a stored reference that is missing or bad.
BenchPlan plan_bench(const Suite& suite, const std::filesystem::path& program, const Host& host,
                     const CellStore& store);

/// The engine's threads: the suite's limit or the host's cores.
int threads_of(const Suite& suite, const Host& host);

}  // namespace photonproof::inline harness_bench
