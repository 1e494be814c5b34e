#include "harness/suites/suite.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "harness/suites/suite_rows.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_suites {
namespace {

namespace fs = std::filesystem;

Cell reference_from_toml(const TomlTable& scene, const SuiteScene& row, const std::vector<Engine>& engines) {
  const TomlTable table = scene.table("reference");
  const Engine& engine = known_engine(table, engines);
  expect_readable(table, "engine", row, engine);
  const std::string budget = table.string("budget");
  if (const auto problem = budget_problem(budget, engine)) throw table.error("budget", *problem);
  const std::int64_t seed = table.integer("seed");
  if (seed < 0) throw table.error("seed", "'seed' must not be negative");
  table.expect_no_other_keys();
  return {row.name, engine.name, *budget_from_text(budget), static_cast<std::uint64_t>(seed)};
}

SuiteScene scene_from_toml(const TomlTable& table, const Suite& suite) {
  SuiteScene scene = scene_row(table, suite);
  if (table.has("reference")) scene.reference = reference_from_toml(table, scene, suite.engines);
  if (table.has("target_relmse")) {
    scene.target_relmse =
        table.is_array("target_relmse") ? table.numbers("target_relmse") : std::vector{table.number("target_relmse")};
    if (std::ranges::any_of(scene.target_relmse, [](double target) { return target <= 0; }))
      throw table.error("target_relmse", "'target_relmse' must be positive");
  }
  table.expect_no_other_keys();
  return scene;
}

std::vector<std::string> scenes_of_run(const TomlTable& run, const Suite& suite) {
  std::vector<std::string> names;
  if (!run.has("scenes")) {
    for (const SuiteScene& scene : suite.scenes) names.push_back(scene.name);
    return names;
  }
  names = run.strings("scenes");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (find_named(suite.scenes, names[i]) == nullptr)
      throw run.error("scenes", i, unknown_name("scene", names[i], suite.scenes));
  return names;
}

void add_run(const TomlTable& run, Suite& suite, std::set<std::string>& labels) {
  const auto engines = named_rows("engine", "engines", run, suite.engines);
  const std::vector<std::string> budgets = run.strings("budgets");
  for (const Engine* engine : engines)
    for (std::size_t i = 0; i < budgets.size(); ++i)
      if (const auto problem = budget_problem(budgets[i], *engine)) throw run.error("budgets", i, *problem);
  const std::vector<std::int64_t> seeds = run.integers("seeds");
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (seeds[i] < 0) throw run.error("seeds", i, "a seed must not be negative");
  const std::vector<std::string> scenes = scenes_of_run(run, suite);
  run.expect_no_other_keys();
  for (const Engine* engine : engines)
    for (const std::string& scene : scenes)
      expect_readable(run, run.has("engines") ? "engines" : "engine", suite.scene(scene), *engine);
  const auto add = [&](const Cell& cell) {
    const std::optional<Cell>& reference = suite.scene(cell.scene).reference;
    if (reference && cell.label() == reference->label())
      throw run.error("the cell " + cell.label() + " is the scene's reference; it would be compared with itself");
    if (!labels.insert(cell.label()).second) throw run.error("the cell " + cell.label() + " occurs twice");
    suite.cells.push_back(cell);
  };
  for (const Engine* engine : engines)
    for (const std::string& scene : scenes)
      for (const std::string& budget : budgets)
        for (const std::int64_t seed : seeds)
          add({scene, engine->name, *budget_from_text(budget), static_cast<std::uint64_t>(seed)});
}

void add_control(const TomlTable& table, Suite& suite) {
  if (table.has("control")) {
    suite.control = table.string("control");
    const Engine* engine = find_named(suite.engines, suite.control);
    if (engine == nullptr) throw table.error("control", unknown_name("engine", suite.control, suite.engines));
    Engine twin = *engine;
    twin.name = control_name(suite.control);
    twin.title += ", a second time";
    if (find_named(suite.engines, twin.name) != nullptr)
      throw table.error("control", "there is an engine '" + twin.name + "' already");
    suite.engines.push_back(std::move(twin));
    std::vector<Cell> twins;
    for (Cell cell : suite.cells) {
      if (cell.engine != suite.control) continue;
      cell.engine = control_name(suite.control);
      twins.push_back(std::move(cell));
    }
    for (SuiteScene& scene : suite.scenes)
      if (const auto own = scene.files.find(suite.control); own != scene.files.end())
        scene.files[control_name(suite.control)] = own->second;
    if (twins.empty()) throw table.error("control", "engine '" + suite.control + "' has no [[run]]");
    suite.cells.insert(suite.cells.end(), twins.begin(), twins.end());
  }
}

void add_bench(const TomlTable& document, Suite& suite) {
  if (!document.has("bench")) return;
  const TomlTable table = document.table("bench");
  add_control(table, suite);
  if (table.has("clock")) {
    const std::string name = table.string("clock");
    const std::optional<Clock> clock = clock_from_string(name);
    if (!clock) throw table.error("clock", "'" + name + "' is no clock; there are wall and processor");
    suite.clock = *clock;
  }
  table.expect_no_other_keys();
}

}  // namespace

std::string control_name(const std::string& engine) { return engine + "-control"; }

const fs::path& SuiteScene::file_for(const std::string& engine_name) const {
  const auto own = files.find(engine_name);
  return own == files.end() ? path : own->second;
}

std::string SuiteScene::file_content(const std::string& engine_name) const {
  const auto own = files.find(engine_name);
  return own == files.end() ? "" : read_file(own->second, max_scene_file_bytes);
}

const Engine& SuiteCommon::engine(const std::string& engine_name) const { return *find_named(engines, engine_name); }

const SuiteScene& SuiteCommon::scene(const std::string& scene_name) const { return *find_named(scenes, scene_name); }

std::optional<Budget> budget_from_text(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  Budget budget;
  budget.kind = text.substr(0, equals);
  if (budget.kind.find_first_not_of("abcdefghijklmnopqrstuvwxyz-_") != std::string::npos) return std::nullopt;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data() + equals + 1, end, budget.amount);
  if (error != std::errc{} || stopped != end || !std::isfinite(budget.amount) || budget.amount <= 0)
    return std::nullopt;
  return budget;
}

Suite read_suite(const fs::path& file) {
  const std::string text = read_file(file, max_suite_bytes);
  expect_required_keys(TomlTable::parse(text, file.string()));
  const TomlTable document = TomlTable::parse(text, file.string());
  Suite suite;
  suite.file = file;
  suite.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  suite.name = file_name(document, "name");
  suite.title = document.string("title");
  suite.limits = limits_from_toml(document);
  suite.engines = builtin_engines();
  for (Engine& engine : engines_from_toml(document, suite.engines)) suite.engines.push_back(std::move(engine));
  for (const TomlTable& table : document.tables("scene")) suite.scenes.push_back(scene_from_toml(table, suite));
  std::set<std::string> labels;
  for (const TomlTable& run : document.tables("run")) add_run(run, suite, labels);
  add_bench(document, suite);
  document.expect_no_other_keys();
  if (suite.scenes.empty()) throw document.error("the suite has no [[scene]]");
  return suite;
}

}  // namespace photonproof::inline harness_suites
