// The plan of a run before anything is measured: every cell with its command, its key and its earlier result.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/images/image_source.h"
#include "harness/suites/suite.h"
#include "reference/store/reference_store.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_bench {

struct PlannedCell {
  Cell cell;
  bool is_reference = false;
  std::string key{};
  std::optional<std::string> unsupported{};     ///< why the engine cannot render the scene, known without trying
  Status status_untried = Status::unsupported;  ///< the status of its result in that case
  std::optional<KeptImage> found{};             ///< its latest result
};

struct BenchPlan {
  std::vector<SceneRecord> scenes;
  std::vector<EngineRecord> engines;              ///< those that a cell uses
  std::vector<PlannedCell> cells;                 ///< references first, then the suite's order
  std::map<std::string, StoredReference> stored;  ///< by scene, of those that the run renders no reference for
  std::map<std::string, std::optional<Expect>> expectations;  ///< by scene
  std::map<std::string, ImageEngine> drawn_by;                ///< by engine, if a cell uses it
  std::map<std::string, ImageScene> drawn;                    ///< by scene

  PlannedCell& find(const std::string& label);  ///< precondition: it exists
  const PlannedCell& find(const std::string& label) const;
};

/// Runs the engines' version commands, reads the scenes and their expectations, and looks up kept images in `source`.
/// `program` is this program. Throws InputError for a scene or expect.toml that cannot be read, and for a stored
/// reference that is missing or bad.
BenchPlan plan_bench(const Suite& suite, const std::filesystem::path& program, const ImageSource& source);

}  // namespace photonproof::inline harness_bench
