#include "harness/verbs/suite_reference.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "harness/gates/gate_suite.h"
#include "harness/references/given_reference.h"
#include "harness/references/suite_scene.h"
#include "harness/suites/suite_rows.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/versions.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/percent_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

/// The common part of both kinds of suites, and the budgets of their gates or cells.
struct AnySuite {
  SuiteCommon common;
  std::vector<Cell> uses;
};

AnySuite read_any_suite(const fs::path& file) {
  const TomlTable document = TomlTable::parse(read_file(file, max_suite_bytes), file.string());
  AnySuite any;
  if (document.has("gate")) {
    const GateSuite suite = read_gate_suite(file);
    any.common = suite;
    for (const Gate& gate : suite.gates) any.uses.push_back({gate.scene, gate.engine, gate.budget, 0});
  } else {
    const Suite suite = read_suite(file);
    any.common = suite;
    any.uses = suite.cells;
  }
  return any;
}

/// A suite of one scene that our program reads.
AnySuite suite_of(const fs::path& scene_file) {
  if (scene_file.extension() != ".xml")
    throw InputError(scene_file.string(),
                     "is no scene that this program reads: list it as a [[scene]] of a suite, then: "
                     "photonproof reference SUITE.toml --scene NAME --from IMAGE");
  const FilmDescription film = parse_scene_file(scene_file.string()).sensor.film;
  AnySuite any;
  any.common.file = scene_file;
  any.common.folder = scene_file.has_parent_path() ? scene_file.parent_path() : fs::path(".");
  any.common.engines = builtin_engines();
  SuiteScene scene;
  scene.name = scene_file.stem().string();
  scene.path = scene.given_path = scene_file.string();
  scene.width = film.width;
  scene.height = film.height;
  any.common.scenes.push_back(std::move(scene));
  return any;
}

const SuiteScene& chosen_scene(const SuiteCommon& suite, const std::string& name) {
  if (name.empty() && suite.scenes.size() == 1) return suite.scenes.front();
  if (name.empty()) throw InputError("--scene", "the suite has several scenes, name one of: " + names_of(suite.scenes));
  const SuiteScene* scene = find_named(suite.scenes, name);
  if (scene == nullptr) throw InputError("--scene", unknown_name("scene", name, suite.scenes));
  return *scene;
}

Budget budget_for(const AnySuite& suite, const SuiteScene& scene, const Engine& engine, const std::string& asked) {
  if (!asked.empty()) {
    if (const auto problem = budget_problem(asked, engine)) throw InputError("--budget", *problem);
    return *budget_from_text(asked);
  }
  for (const bool same_engine : {true, false})
    for (const Cell& use : suite.uses)
      if (use.scene == scene.name && (use.engine == engine.name || !same_engine) && engine.accepts(use.budget.kind))
        return use.budget;
  throw InputError("--budget", "give the budget of one image, such as spp=64");
}

std::optional<MadeReference> made_by_engine(const AnySuite& suite, const SuiteScene& scene,
                                            const SuiteReferenceArguments& arguments,
                                            const std::string& progress_mode) {
  const Engine* engine = find_named(suite.common.engines, arguments.engine);
  if (engine == nullptr) throw InputError("--engine", unknown_name("engine", arguments.engine, suite.common.engines));
  EngineDraw draw{.program = fs::read_symlink("/proc/self/exe"), .interrupt = &interrupt_flag()};
  Progress progress(progress_mode);
  draw.progress = [&](std::size_t done, std::size_t total) {
    progress.at(counted(done, total, engine->name, "images"));
  };
  return reference_by_engine(suite.common, scene,
                             {*engine, budget_for(suite, scene, *engine, arguments.budget), arguments.images}, draw);
}

void check(const SuiteReferenceArguments& arguments) {
  if (arguments.from.empty() == arguments.engine.empty())
    throw InputError("reference", "a suite's scene needs --from IMAGE... or --engine NAME");
  if (!arguments.engine.empty() && !(arguments.variance.empty() && arguments.transfer.empty()))
    throw InputError("--engine", "renders its own images; --variance and --transfer are for --from");
  if (arguments.engine.empty() && !arguments.budget.empty()) throw InputError("--budget", "is for --engine");
}

void print(const SuiteScene& scene, const Provenance& p, const fs::path& file, bool json) {
  if (json) {
    nlohmann::ordered_json record = {{"files", {file.string()}}, {"reached", true}};
    record["provenance"] = nlohmann::ordered_json::parse(provenance_text(p));
    std::printf("%s\n", json_text(record).c_str());
    return;
  }
  const std::string noise = has_unknown_noise(p) ? "noise unknown: state it with --variance, or give several images"
                                                 : "standard error " + percent_text(p.standard_error);
  std::printf("%s: %s, %dx%d, %llu %s, %s\nreference: %s\n", scene.name.c_str(), p.estimator.c_str(), p.width, p.height,
              static_cast<unsigned long long>(p.given->images), p.given->images == 1 ? "image" : "images",
              noise.c_str(), file.c_str());
}

}  // namespace

int make_suite_reference(const std::string& path, const SuiteReferenceArguments& arguments, const std::string& reason,
                         bool json, const std::string& progress_mode) {
  check(arguments);
  const bool is_suite = fs::path(path).extension() == ".toml";
  const AnySuite suite = is_suite ? read_any_suite(path) : suite_of(path);
  const SuiteScene& scene = chosen_scene(suite.common, arguments.scene);
  const fs::path beside = stored_beside(scene), file = committed_reference_path(beside, scene.width, scene.height);
  if (reason.empty() && has_good_commit(beside, content_of(scene).hash, scene.width, scene.height))
    throw InputError(file.string(), reason_is_missing);
  std::optional<MadeReference> made =
      arguments.from.empty()
          ? made_by_engine(suite, scene, arguments, progress_mode)
          : reference_from_files(
                scene, {{arguments.from.begin(), arguments.from.end()}, arguments.variance, arguments.transfer});
  if (!made) return 130;
  made->provenance.versions.merge(program_versions());
  print(scene, store_reference_of(scene, *made, reason), file, json);
  return 0;
}

}  // namespace photonproof::inline harness_verbs
