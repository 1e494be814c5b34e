#include "harness/cells/cell_command.h"

#include "harness/cells/scene_copies.h"
#include "harness/suites/engine_command.h"
#include "scenes/base/faults.h"

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;

fs::path short_path(const fs::path& path) {
  const fs::path near = fs::proximate(path);
  return near.string().size() < path.string().size() ? near : path;
}

}  // namespace

CellCommand cell_command(const SuiteCommon& suite, const Cell& cell, const fs::path& program, const fs::path& folder,
                         const std::string& stem, int threads, SceneCopies* copies) {
  const SuiteScene& scene = suite.scene(cell.scene);
  const Engine& engine = suite.engine(cell.engine);
  CellCommand command;
  command.image = short_path(folder) / (stem + "." + engine.image_extension);
  command.layer = engine.layer;
  command.stats = short_path(folder) / (stem == "image" ? "stats.json" : stem + ".stats.json");

  CommandValues values;
  values.photonproof = short_path(program);
  // A bare name would be looked up on PATH.
  if (!values.photonproof.has_parent_path()) values.photonproof = fs::path(".") / values.photonproof;
  values.suite = short_path(suite.folder);
  const fs::path& own = scene.file_for(cell.engine);
  values.scene = short_path(own);
  values.scene_name = scene.name;
  values.output = command.image;
  values.stats = command.stats;
  values.width = scene.width;
  values.height = scene.height;
  values.threads = threads;
  values.seed = has_fault(Fault::repeated_seed) ? 1 : cell.seed;
  values.budget = cell.budget;
  if (has_fault(Fault::quarter_budget)) values.budget.amount /= 4;
  command.typed = fill_command(engine.command, values);
  if (copies != nullptr) {
    values.scene = short_path(copies->of(scene, own));
    command.own_folder = short_path(own.has_parent_path() ? own.parent_path() : fs::path(".")).string();
    command.given_folder = values.scene.parent_path().string();
  }
  command.argv = fill_command(engine.command, values);
  command.start_hint = start_hint(engine.command, suite.folder);
  command.argument_hint = argument_hint(engine.command, suite.folder);
  return command;
}

CellRun cell_run(const Cell& cell, const CellCommand& command, const SuiteScene& scene,
                 const std::optional<FilmPart>& crop, const Limits& limits, const std::atomic<bool>* interrupt) {
  CellRun run;
  run.cell = cell;
  run.argv = command.argv;
  run.image = command.image;
  run.layer = command.layer;
  run.stats = command.stats;
  run.output_folder = command.image.parent_path();
  run.width = scene.width;
  run.height = scene.height;
  run.crop = crop;
  run.limits = limits;
  run.interrupt = interrupt;
  run.typed = command.typed;
  run.given_folder = command.given_folder;
  run.own_folder = command.own_folder;
  run.start_hint = command.start_hint;
  run.argument_hint = command.argument_hint;
  return run;
}

}  // namespace photonproof::inline harness_cells
