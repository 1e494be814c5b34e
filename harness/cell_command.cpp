#include "harness/cell_command.h"

#include "harness/engine_command.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

fs::path short_path(const fs::path& path) {
  const fs::path near = fs::proximate(path);
  return near.string().size() < path.string().size() ? near : path;
}

}  // namespace

CellCommand cell_command(const SuiteCommon& suite, const Cell& cell, const fs::path& program, const fs::path& folder,
                         const std::string& stem, int threads) {
  const SuiteScene& scene = suite.scene(cell.scene);
  const Engine& engine = suite.engine(cell.engine);
  CellCommand command;
  command.image = short_path(folder) / (stem + "." + engine.image_extension);
  command.stats = short_path(folder) / (stem == "image" ? "stats.json" : stem + ".stats.json");

  CommandValues values;
  values.photonproof = short_path(program);
  // A bare name would be looked up on PATH.
  if (!values.photonproof.has_parent_path()) values.photonproof = fs::path(".") / values.photonproof;
  values.suite = short_path(suite.folder);
  values.scene = short_path(scene.path);
  values.output = command.image;
  values.stats = command.stats;
  values.width = scene.width;
  values.height = scene.height;
  values.threads = threads;
  values.seed = cell.seed;
  values.budget = cell.budget;
  command.argv = fill_command(engine.command, values);
  return command;
}

}  // namespace photonproof
