#include "harness/bench.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "harness/bench_plan.h"
#include "harness/cells.h"
#include "harness/compare_cell.h"
#include "harness/engine_command.h"
#include "harness/folder_lock.h"
#include "harness/host.h"
#include "harness/run_cell.h"
#include "scenes/atomic_file.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

bool is_failure(Status status) {
  return status == Status::timeout || status == Status::crash || status == Status::bad_image;
}

// As a person would type it: from the current folder where that is shorter.
fs::path short_path(const fs::path& path) {
  const fs::path near = fs::proximate(path);
  return near.string().size() < path.string().size() ? near : path;
}

class Bench {
 public:
  Bench(const Suite& suite, const BenchOptions& options, BenchObserver& observer)
      : suite_(suite),
        options_(options),
        observer_(observer),
        lock_(options.results_folder),
        store_(options.results_folder),
        host_(describe_host()),
        plan_(plan_bench(suite, options.program, host_, store_)),
        created_(utc_now()) {}

  BenchSummary run() {
    const std::vector<Cell> to_run = choose_cells();
    if (to_run.empty()) keep_creation_time();
    if (options_.fresh && !to_run.empty()) set_old_record_aside();
    compare_found_cells();
    save();
    for (std::size_t i = 0; i < to_run.size() && !summary_.interrupted; ++i) {
      if (!measure(i + 1, to_run.size(), plan_.find(to_run[i].label()))) summary_.interrupted = true;
    }
    count();
    return summary_;
  }

 private:
  fs::path results_file() const { return options_.results_folder / "results.json"; }

  bool is_selected(const Cell& cell) const { return cell.label().find(options_.only) != std::string::npos; }

  bool is_wanted(const PlannedCell& planned) const {
    if (planned.unsupported) return false;
    if (!planned.found) return true;
    return options_.fresh || (options_.retry && is_failure(planned.found->kept.result.status));
  }

  // References first: all others are compared with them.
  std::vector<Cell> choose_cells() {
    if (std::none_of(plan_.cells.begin(), plan_.cells.end(), [&](const auto& p) { return is_selected(p.cell); }))
      throw InputError("--only", "no cell of the suite has '" + options_.only + "' in its label");
    std::vector<Cell> references, others;
    for (const PlannedCell& planned : plan_.cells)
      if (!planned.is_reference && is_selected(planned.cell) && is_wanted(planned)) others.push_back(planned.cell);
    for (const PlannedCell& planned : plan_.cells) {
      if (!planned.is_reference) continue;
      const bool needed = !planned.found && std::any_of(others.begin(), others.end(), [&](const Cell& other) {
        return other.scene == planned.cell.scene;
      });
      if (is_wanted(planned) && (needed || is_selected(planned.cell))) references.push_back(planned.cell);
    }
    for (Cell& cell : interleaved_by_engine(others)) references.push_back(std::move(cell));
    return references;
  }

  // Nothing is measured: the record stays as old as its measurements.
  void keep_creation_time() {
    if (!fs::exists(results_file())) return;
    try {
      created_ = read_results(results_file().string()).created;
    } catch (const InputError&) {
      // Damaged or of another version; it is about to be replaced from the cells.
    }
  }

  void set_old_record_aside() {
    if (!fs::exists(results_file())) return;
    int n = 1;
    const auto name = [&] { return options_.results_folder / ("results-" + std::to_string(n) + ".json"); };
    while (fs::exists(name())) ++n;
    write_file_atomically(name(), read_file(results_file()));
  }

  // False when interrupted.
  bool measure(std::size_t number, std::size_t total, PlannedCell& planned) {
    observer_.starts(number, total, planned.cell);
    const SuiteScene& scene = suite_.scene(planned.cell.scene);
    const Engine& engine = suite_.engine(planned.cell.engine);
    const std::string cell_folder = store_.make_folder(planned.key);
    const fs::path folder = short_path(options_.results_folder / cell_folder);
    const std::string image_name = "image." + engine.image_extension;

    CommandValues values;
    values.photonproof = short_path(options_.program);
    // A bare name would be looked up on PATH.
    if (!values.photonproof.has_parent_path()) values.photonproof = fs::path(".") / values.photonproof;
    values.suite = short_path(suite_.folder);
    values.scene = short_path(scene.path);
    values.output = folder / image_name;
    values.stats = folder / "stats.json";
    values.width = scene.width;
    values.height = scene.height;
    values.threads = threads_of(suite_, host_);
    values.seed = planned.cell.seed;
    values.budget = planned.cell.budget;
    std::optional<Result> result =
        run_cell({planned.cell, fill_command(engine.command, values), values.output, values.stats, folder, scene.width,
                  scene.height, suite_.limits, options_.interrupt});
    if (!result) return false;
    result->key = planned.key;
    result->engine_version = version_of(engine.name);
    if (fs::exists(values.output)) result->image = cell_folder + "/" + image_name;
    planned.found = CellStore::Found{{std::move(*result), ""}, cell_folder};
    compare(planned);
    store_.keep(cell_folder, planned.found->kept);
    if (planned.is_reference) compare_found_cells();
    save();
    ++summary_.measured;
    observer_.ended(number, total, planned.found->kept.result);
    return true;
  }

  std::string version_of(const std::string& engine) const {
    return std::find_if(plan_.engines.begin(), plan_.engines.end(),
                        [&](const EngineRecord& record) { return record.name == engine; })
        ->version;
  }

  const SceneRecord& scene_record(const std::string& name) const {
    return *std::find_if(plan_.scenes.begin(), plan_.scenes.end(),
                         [&](const SceneRecord& record) { return record.name == name; });
  }

  // Whether the cell's metrics and pictures had to be made.
  bool compare(PlannedCell& planned) {
    Result& result = planned.found->kept.result;
    if (result.status != Status::ok) return false;
    const SceneRecord& scene = scene_record(planned.cell.scene);
    const PlannedCell& reference = plan_.find(scene.reference_label);
    const Result unsupported_reference = reference.unsupported ? unsupported_result(reference) : Result{};
    const Result* reference_result = reference.found         ? &reference.found->kept.result
                                     : reference.unsupported ? &unsupported_reference
                                                             : nullptr;
    const std::string key =
        content_key({{"reference", reference.found ? reference.found->cell_folder : reference.unsupported.value_or("")},
                     {"exposure", std::to_string(scene.exposure)},
                     {"version", options_.comparison_version}});
    if (planned.found->kept.comparison_key == key) return false;
    compare_cell({options_.results_folder, planned.found->cell_folder, reference_result, scene.exposure}, result);
    planned.found->kept.comparison_key = key;
    return true;
  }

  // Cells measured earlier whose reference, exposure or metrics are others now.
  void compare_found_cells() {
    for (PlannedCell& planned : plan_.cells)
      if (planned.found && compare(planned)) store_.keep(planned.found->cell_folder, planned.found->kept);
  }

  Result unsupported_result(const PlannedCell& planned) const {
    Result result;
    result.cell = planned.cell;
    result.key = planned.key;
    result.status = Status::unsupported;
    result.detail = *planned.unsupported;
    result.engine_version = version_of(planned.cell.engine);
    return result;
  }

  void save() const {
    Results results;
    results.suite = suite_.name;
    results.created = created_;
    results.command = options_.command;
    results.host = host_;
    results.versions = options_.versions;
    results.scenes = plan_.scenes;
    results.engines = plan_.engines;
    for (const PlannedCell& planned : plan_.cells) {
      if (planned.unsupported) results.results.push_back(unsupported_result(planned));
      if (planned.found) results.results.push_back(planned.found->kept.result);
    }
    write_results(results_file().string(), results);
  }

  void count() {
    summary_.results_file = results_file();
    for (const PlannedCell& planned : plan_.cells) {
      if (planned.unsupported) ++summary_.by_status[Status::unsupported];
      if (planned.found) ++summary_.by_status[planned.found->kept.result.status];
      if (!planned.unsupported && !planned.found) ++summary_.missing;
      if (planned.found) ++summary_.kept;
    }
    summary_.kept -= summary_.measured;
  }

  const Suite& suite_;
  const BenchOptions& options_;
  BenchObserver& observer_;
  FolderLock lock_;
  CellStore store_;
  Host host_;
  BenchPlan plan_;
  std::string created_;
  BenchSummary summary_;
};

}  // namespace

BenchSummary run_bench(const Suite& suite, const BenchOptions& options, BenchObserver& observer) {
  return Bench(suite, options, observer).run();
}

}  // namespace photonproof
