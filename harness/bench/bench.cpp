#include "harness/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/bench/bench_findings.h"
#include "harness/bench/bench_plan.h"
#include "harness/bench/compare_cell.h"
#include "harness/bench/correctness.h"
#include "harness/cells/calibration.h"
#include "harness/cells/cells.h"
#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/cells/scene_copies.h"
#include "harness/cells/side_by_side.h"
#include "harness/conclusions/convergence.h"
#include "harness/conclusions/race.h"
#include "harness/conclusions/session_quality.h"
#include "harness/gates/gate_pictures.h"
#include "harness/gates/independence.h"
#include "harness/references/suite_scene.h"
#include "reference/store/reference_store.h"
#include "scenes/base/edit_distance.h"
#include "scenes/base/input_error.h"
#include "scenes/base/timer.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_bench {
namespace {

namespace fs = std::filesystem;

bool is_failure(Status status) {
  return status == Status::timeout || status == Status::crash || status == Status::bad_image;
}

// A results.json that takes longer to write is not written after every cell.
constexpr double quick_save_seconds = 0.01;
constexpr double tolerated_save_share = 0.005;
// An engine with this many cells renders its first cell once before, for at most so long.
constexpr std::size_t least_cells_for_warm_up = 3;
constexpr double warm_up_limit = 2;
constexpr const char* warm_up_folder = "cells/warm-up";

// A number that depends on the suite's name alone.
std::uint64_t order_seed(const Suite& suite) {
  return std::stoull(content_key({{"order", suite.name}}).substr(0, 15), nullptr, 16);
}

class Bench {
 public:
  Bench(const Suite& suite, const BenchOptions& options, BenchObserver& observer)
      : suite_(suite),
        options_(options),
        observer_(observer),
        old_run_(options.against ? std::optional(read_old_run(*options.against)) : std::nullopt),
        lock_(options.results_folder),
        copies_(options.results_folder),
        host_(describe_host()),
        source_(source_options()),
        plan_(plan_bench(suite, options.program, source_)),
        created_(utc_now()) {
    for (SceneRecord& scene : plan_.scenes)
      if (const auto stored = plan_.stored.find(scene.name); stored != plan_.stored.end())
        scene.reference = store_reference(stored->second, scene.name, scene.exposure, options.results_folder);
  }

  BenchSummary run() {
    const Timer timer;
    const double own_before = own_cpu_seconds();
    const std::vector<Cell> to_run = choose_cells();
    add_note_on_opaque();
    if (to_run.empty()) keep_session();
    if (options_.fresh && !to_run.empty()) set_old_record_aside();
    sweep();
    if (!to_run.empty())
      if (const std::string caveat = load_caveat(host_.cores); !caveat.empty()) caveats_.push_back(caveat);
    save();
    warm_up(to_run);
    if (!to_run.empty()) calibration_.emplace(std::min(limits().threads, host_.cores));
    for (std::size_t i = 0; i < to_run.size() && !summary_.interrupted; ++i) {
      if (!measure(i + 1, to_run.size(), plan_.find(to_run[i].label()))) summary_.interrupted = true;
    }
    compare_found_cells();
    conclude(!to_run.empty());
    save();
    summary_.seconds = timer.seconds();
    summary_.harness_cpu_seconds = own_cpu_seconds() - own_before;
    if (options_.against && !summary_.interrupted) compare_with_old();
    count();
    return summary_;
  }

 private:
  void add_note_on_opaque() {
    std::vector<const SuiteScene*> scenes;
    for (const SuiteScene& scene : suite_.scenes) scenes.push_back(&scene);
    if (auto note = note_on_opaque(scenes)) caveats_.push_back(std::move(*note));
  }

  // Engines may use every core unless the suite gives a number of threads.
  Limits limits() const {
    Limits limits = suite_.limits;
    if (limits.threads <= 0) limits.threads = std::max(1, host_.cores);
    return limits;
  }

  ImageSourceOptions source_options() const {
    ImageSourceOptions source{.use = ImageUse::measurement,
                              .folder = options_.results_folder,
                              .program = options_.program,
                              .suite_folder = suite_.folder,
                              .limits = limits()};
    source.interrupt = options_.interrupt;
    return source;
  }

  fs::path results_file() const { return options_.results_folder / "results.json"; }

  bool is_selected(const Cell& cell) const { return cell.label().find(options_.only) != std::string::npos; }

  bool is_wanted(const PlannedCell& planned) const {
    if (planned.unsupported) return false;
    if (!planned.found) return true;
    return options_.fresh || (options_.retry && is_failure(planned.found->kept.result.status));
  }

  // References come first, since all others are compared with them.
  std::vector<Cell> choose_cells() {
    if (std::none_of(plan_.cells.begin(), plan_.cells.end(), [&](const auto& p) { return is_selected(p.cell); })) {
      std::vector<std::string> near;
      for (const PlannedCell& planned : plan_.cells)
        near.insert(near.end(), {planned.cell.scene, planned.cell.engine, planned.cell.label()});
      throw InputError("--only", "no cell of the suite has '" + options_.only + "' in its label" +
                                     did_you_mean(options_.only, near));
    }
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
    for (Cell& cell : interleaved_by_engine(others, order_seed(suite_))) references.push_back(std::move(cell));
    return references;
  }

  // Nothing is measured: the record keeps the date and the session's data of its measurements.
  void keep_session() {
    if (!fs::exists(results_file())) return;
    try {
      Results before = read_results(results_file().string());
      created_ = before.created;
      caveats_ = std::move(before.caveats);
      changes_ = std::move(before.changes);
    } catch (const InputError&) {
      // The record is damaged or of another version; it is about to be replaced from the cells.
    }
  }

  void set_old_record_aside() {
    if (!fs::exists(results_file())) return;
    int n = 1;
    const auto name = [&] { return options_.results_folder / ("results-" + std::to_string(n) + ".json"); };
    while (fs::exists(name())) ++n;
    write_file_atomically(name(), read_file(results_file()));
  }

  // Removes what a killed run left beside its cells.
  void sweep() const {
    std::error_code ignored;
    for (const char* folder : {warm_up_folder, against_folder})
      fs::remove_all(options_.results_folder / folder, ignored);
    remove_all_abandoned_temporaries(options_.results_folder);
  }

  // False when interrupted.
  bool measure(std::size_t number, std::size_t total, PlannedCell& planned) {
    observer_.starts(number, total, planned.cell);
    std::string cell_folder;
    std::optional<Result> result = run_in_folder(planned, cell_folder);
    if (!result) return false;
    summary_.engine_seconds += result->wall_seconds.value_or(0);
    result->calibration = calibration_->after_cell(planned.cell, result->wall_seconds.value_or(0));
    result->key = planned.key;
    planned.found = KeptImage{{std::move(*result), ""}, cell_folder};
    // A program that could not be started may be there the next time.
    if (planned.found->kept.result.status != Status::not_started) keep(*planned.found);
    save_if_quick();
    ++summary_.measured;
    observer_.ended(number, total, planned.found->kept.result);
    return true;
  }

  // A folder that cannot be made, or that the engine removed, is a crash of the cell and does not end the run.
  std::optional<Result> run_in_folder(const PlannedCell& planned, std::string& cell_folder) try {
    cell_folder = source_.claim(planned.key);
    // An engine whose image is the reference may read the scene's committed reference.
    return run_engine(run_of(planned.cell, cell_folder, planned.is_reference ? nullptr : &copies_));
  } catch (const InputError& error) {
    Result result;
    result.cell = planned.cell;
    result.status = Status::crash;
    result.engine_version = version_of(planned.cell.engine);
    result.detail = "its folder cannot be used: " + error.summary();
    return result;
  }

  // Writes the record to the cell's folder. If that is gone, it is in results.json alone and the next run measures it
  // again.
  void keep(KeptImage& found) const try {
    if (!found.folder.empty()) source_.keep(found);
  } catch (const InputError& error) {
    found.kept.result.caveats.push_back("not kept for the next run: " + error.summary());
  }

  EngineRun run_of(const Cell& cell, const std::string& folder, SceneCopies* copies) const {
    EngineRun run =
        source_.run_of(folder, plan_.drawn_by.at(cell.engine), plan_.drawn.at(cell.scene), cell.budget, cell.seed);
    run.scene.copies = copies;
    return run;
  }

  // Takes an engine's one-time costs (reading its files from disk, waking the processors) out of the measurement.
  void warm_up(const std::vector<Cell>& to_run) {
    std::map<std::string, std::vector<const Cell*>> by_engine;
    for (const Cell& cell : to_run) by_engine[cell.engine].push_back(&cell);
    const fs::path folder = options_.results_folder / warm_up_folder;
    std::error_code ignored;
    for (const auto& [engine, cells] : by_engine) {
      if (cells.size() < least_cells_for_warm_up) continue;
      fs::create_directories(folder, ignored);
      EngineRun run = run_of(*cells.front(), warm_up_folder, &copies_);
      run.limits.seconds = std::min(run.limits.seconds, warm_up_limit);
      const auto result = run_engine(run);
      if (result) summary_.engine_seconds += result->wall_seconds.value_or(0);
      fs::remove_all(folder, ignored);
    }
  }

  const std::string& version_of(const std::string& engine) const { return plan_.drawn_by.at(engine).version; }

  const SceneRecord& scene_record(const std::string& name) const {
    return *std::find_if(plan_.scenes.begin(), plan_.scenes.end(),
                         [&](const SceneRecord& record) { return record.name == name; });
  }

  struct ReferenceOfScene {
    std::optional<Result> result;  // what it is compared with; empty while there is none yet
    std::string identity;          // differs where the pixels differ
  };

  ReferenceOfScene reference_of(const SceneRecord& scene) const {
    if (scene.reference) {
      Result stored;
      stored.image = scene.reference->image;
      return {std::move(stored), "stored " + plan_.stored.at(scene.name).provenance.pixels};
    }
    const PlannedCell& planned = plan_.find(scene.reference_label);
    if (planned.unsupported) return {unsupported_result(planned), *planned.unsupported};
    if (!planned.found) return {};
    return {planned.found->kept.result, planned.found->folder};
  }

  // Whether the cell's metrics and pictures had to be made.
  bool compare(PlannedCell& planned) {
    Result& result = planned.found->kept.result;
    if (result.status != Status::ok) return false;
    const SceneRecord& scene = scene_record(planned.cell.scene);
    const ReferenceOfScene reference = reference_of(scene);
    std::vector<std::pair<std::string, std::string>> made_with = {{"reference", reference.identity},
                                                                  {"exposure", std::to_string(scene.exposure)},
                                                                  {"version", options_.comparison_version}};
    if (const auto& range = scene.hdr_exposures)
      made_with.emplace_back("hdr_flip_exposures", fmt::format("{} {} {}", range->start, range->stop, range->count));
    const std::string key = content_key(made_with);
    if (planned.found->kept.comparison_key == key) return false;
    try {
      compare_cell({options_.results_folder, planned.found->folder, reference.result ? &*reference.result : nullptr,
                    scene.exposure, scene.hdr_exposures},
                   result);
      planned.found->kept.comparison_key = key;
    } catch (const InputError& error) {
      result.caveats.push_back("its pictures could not be made: " + error.summary());
    }
    return true;
  }

  // Compares cells that were not compared yet, or whose reference, exposures or metrics changed. No engine is measured
  // any more, so every core may help.
  void compare_found_cells() {
    for (const bool references : {true, false})  // the others read the references
      side_by_side(plan_.cells.size(), host_.cores, [&](std::size_t i) {
        PlannedCell& planned = plan_.cells[i];
        if (planned.is_reference == references && planned.found && compare(planned)) keep(*planned.found);
      });
  }

  void conclude(bool measured) {
    const Results results = record();
    ErrorTargets targets;
    for (const SuiteScene& scene : suite_.scenes) targets[scene.name] = scene.target_relmse;
    findings_ = findings_of_bench(results, options_.results_folder);
    try {
      draw_conclusions(results, targets);
    } catch (const InputError& error) {  // an image that was removed since it was compared
      caveats_.push_back("no conclusions were drawn: " + error.summary());
    }
    if (!measured || suite_.control.empty()) return;
    const std::string caveat = control_caveat(results, suite_.control, control_name(suite_.control));
    if (!caveat.empty()) caveats_.push_back(caveat);
  }

  void draw_conclusions(const Results& results, const ErrorTargets& targets) {
    const References references = load_references();
    const auto judge = [&](const Cell& like, std::span<const Image> images) {
      return judge_correctness(judge_of(like.scene, references), suite_.engine(like.engine), like.budget, images);
    };
    convergence_ = convergence_of(results, options_.results_folder, targets, judge, suite_.clock);
    for (Convergence& curve : convergence_)
      if (suite_.engine(curve.engine).trust == Trust::unbiased) reconcile(curve.points);
    races_ = races_of(convergence_);
  }

  using References = std::map<std::string, StoredReference>;

  // References that the run rendered itself, as far as they exist.
  References load_references() const {
    References references;
    for (const SceneRecord& scene : plan_.scenes) {
      if (scene.reference || !scene.reference_doubt.empty()) continue;
      const std::optional<Result> result = reference_of(scene).result;
      if (!result || result->status != Status::ok) continue;
      StoredReference reference;
      try {
        reference.rendering = read_stored((options_.results_folder / result->image).string());
      } catch (const InputError&) {
        continue;  // removed since: then nothing is known
      }
      reference.provenance.estimator = integrator_of(suite_.engine(result->cell.engine)).value_or("");
      references.emplace(scene.name, std::move(reference));
    }
    return references;
  }

  Judge judge_of(const std::string& scene, const References& rendered) const {
    const auto of = [&](const References& references) {
      const auto found = references.find(scene);
      return found == references.end() ? nullptr : &found->second;
    };
    const StoredReference* stored = of(plan_.stored);
    return {stored != nullptr ? stored : of(rendered), scene_record(scene).reference_doubt,
            &plan_.expectations.at(scene)};
  }

  void compare_with_old() {
    const Results now = record();
    AgainstRun run{suite_,
                   now,
                   options_.program,
                   options_.results_folder,
                   options_.only,
                   options_.interrupt,
                   [this](const ChangeRecord& change) { observer_.changed(change); },
                   [this](const Cell& cell, const std::string& folder) { return run_of(cell, folder, nullptr); }};
    changes_ = changes_against(run, *old_run_, *options_.against);
    summary_.interrupted = options_.interrupt != nullptr && *options_.interrupt;
    for (const ChangeRecord& change : changes_) ++summary_.by_change[change.change];
    save();
  }

  Result unsupported_result(const PlannedCell& planned) const {
    Result result;
    result.cell = planned.cell;
    result.key = planned.key;
    result.status = planned.status_untried;
    result.detail = *planned.unsupported;
    result.engine_version = version_of(planned.cell.engine);
    return result;
  }

  void save_if_quick() {
    if (save_seconds_ < quick_save_seconds || save_seconds_ < tolerated_save_share * since_save_.seconds()) save();
  }

  void save() {
    const Timer timer;
    write_results(results_file().string(), record());
    save_seconds_ = timer.seconds();
    since_save_ = {};
  }

  Results record() const {
    Results results;
    results.suite = suite_.name;
    results.title = suite_.title;
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
    note_absent_instructions(results);
    results.convergence = convergence_;
    results.races = races_;
    results.changes = changes_;
    results.findings = findings_;
    results.caveats = caveats_;
    return results;
  }

  void count() {
    summary_.results_file = results_file();
    for (const PlannedCell& planned : plan_.cells) {
      if (planned.unsupported) ++summary_.by_status[planned.status_untried];
      if (planned.found) ++summary_.by_status[planned.found->kept.result.status];
      if (!planned.unsupported && !planned.found) ++summary_.missing;
      if (planned.found) ++summary_.kept;
    }
    summary_.kept -= summary_.measured;
  }

  const Suite& suite_;
  const BenchOptions& options_;
  BenchObserver& observer_;
  std::optional<Results> old_run_;
  FolderLock lock_;
  SceneCopies copies_;
  Host host_;
  ImageSource source_;
  BenchPlan plan_;
  std::optional<Calibration> calibration_;  // only if something is measured
  std::string created_;
  std::vector<Convergence> convergence_;
  std::vector<RaceRecord> races_;
  std::vector<ChangeRecord> changes_;
  std::vector<std::string> findings_;
  std::vector<std::string> caveats_;  // warnings of the session
  double save_seconds_ = 0;
  Timer since_save_;
  BenchSummary summary_;
};

}  // namespace

BenchSummary run_bench(const Suite& suite, const BenchOptions& options, BenchObserver& observer) {
  return Bench(suite, options, observer).run();
}

}  // namespace photonproof::inline harness_bench
