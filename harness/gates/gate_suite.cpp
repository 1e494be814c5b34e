#include "harness/gates/gate_suite.h"

#include "harness/gates/gate_look.h"
#include "harness/gates/gate_mutants.h"
#include "harness/metrics/metric_bounds.h"
#include "harness/metrics/metric_rows.h"
#include "harness/references/suite_scene.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/suite_rows.h"
#include "scenes/description/expect.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr int least_ssim_side = 11;
constexpr double block_over_whole = 5;  // a block has 1/64 of a 64 x 64 image's pixels: 8 times its noise

double positive(const TomlTable& table, const std::string& key, double most) {
  const double value = table.number(key);
  if (!(value > 0 && value <= most)) {
    std::string limit = std::to_string(most);
    limit.erase(limit.find_last_not_of('0') + 1);
    if (limit.back() == '.') limit.pop_back();
    throw table.error(key, "'" + key + "' must be positive and at most " + limit);
  }
  return value;
}

/// The keys that the suite sets for all gates and a gate may override.
void read_statistics(const TomlTable& table, Gate& gate) {
  if (table.has("alpha")) gate.alpha = positive(table, "alpha", 0.5);
  if (table.has("seeds")) gate.seeds = bounded_integer(table, "seeds", least_images, 1 << 16);
  if (table.has("looks")) gate.looks = bounded_integer(table, "looks", 1, 12);
}

struct MetricName {
  std::string name;
};

std::vector<MetricName> known_metrics() {
  std::vector<MetricName> names{{agreement_metric}, {block_bias_metric}};
  for (const MetricRow& row : metric_rows()) names.push_back({row.name});
  return names;
}

/// The keys that are parameters of this gate's metric. Any other metric parameter is an error here.
std::vector<GivenParameter> parameters_from_toml(const TomlTable& table, const std::string& metric) {
  const MetricRow* row = weighs_noise(metric) ? nullptr : find_metric(metric);
  std::vector<GivenParameter> given;
  for (const MetricParameter& parameter : metric_parameters) {
    const std::string key = parameter.name;
    if (!table.has(key)) continue;
    if (!row || !has_parameter(*row, parameter))
      throw table.error(
          key, "'" + key + "' is a parameter of " + metrics_with(parameter) + "; " + metric + " does not have it");
    GivenParameter one{&parameter, {}};
    one.numbers = number_count(parameter) == 1 ? std::vector{table.number(key)} : table.numbers(key);
    ParameterValues tried;
    if (const auto problem = set_parameter(parameter, one.numbers, tried))
      throw table.error(key, "'" + key + "': " + *problem);
    given.push_back(std::move(one));
  }
  return given;
}

std::string metric_from_toml(const TomlTable& table, const SuiteScene& scene) {
  const std::string metric = table.string("metric");
  if (metric != agreement_metric && metric != block_bias_metric && find_metric(metric) == nullptr)
    throw table.error("metric", unknown_name("metric", metric, known_metrics()));
  if (metric == "ssim" && std::min(scene.width, scene.height) < least_ssim_side)
    throw table.error("metric", "ssim needs images of at least 11 x 11 pixels");
  if (metric == "hdr_flip" && !table.has("exposures") && !viewing_of(scene).hdr_exposures)
    throw table.error("metric", scene.is_opaque()
                                    ? "hdr_flip needs 'exposures' here"
                                    : "hdr_flip needs the scene to pin its exposures: 'hdr_flip_exposures' in " +
                                          expect_path_of(scene.path.string()) + ", or 'exposures' here");
  return metric;
}

/// A number, or for shares of pixels also "0.1 %".
double bound_from_toml(const TomlTable& table, const std::string& metric) {
  if (weighs_noise(metric)) return positive(table, "bound", 1);
  if (metric != "differing" || !table.is_string("bound")) return table.number("bound");
  const auto share = share_from_text(table.string("bound"));
  if (!share) throw table.error("bound", "'bound' must be a number, such as 0.001, or a text such as \"0.1 %\"");
  return *share;
}

/// The gate of one scene and engine of the row. `several`: the row has more than one of either.
Gate gate_from_toml(const TomlTable& table, const GateSuite& suite, const Gate& defaults, const SuiteScene& scene,
                    const Engine& engine, bool several) {
  Gate gate = defaults;
  gate.scene = scene.name;
  gate.engine = engine.name;
  gate.takes_seed = mentions(engine.command, "{seed}");
  gate.unbiased = engine.trust == Trust::unbiased;
  expect_readable(table, table.has("engines") ? "engines" : "engine", scene, engine);
  const std::string budget = table.string("budget");
  if (const auto problem = budget_problem(budget, engine)) throw table.error("budget", *problem);
  gate.budget = *budget_from_text(budget);
  gate.metric = metric_from_toml(table, scene);
  gate.parameters = parameters_from_toml(table, gate.metric);
  if (engine.denoises && weighs_noise(gate.metric))
    throw table.error("metric", "engine '" + engine.name +
                                    "' denoises, which makes errors that no number of images averages out; bound a "
                                    "metric of one image, such as relmse");
  if (gate.metric == agreement_metric && engine.trust == Trust::biased)
    throw table.error("metric", "engine '" + engine.name +
                                    "' has a known error, which agreement would find; bound it by bias or block_bias");
  gate.bound = bound_from_toml(table, gate.metric);
  if (gate.metric == agreement_metric)
    gate.block_bound = table.has("block_bound") ? positive(table, "block_bound", 10) : block_over_whole * gate.bound;
  const std::string place = gate.scene + "/" + gate.engine;
  gate.name = !table.has("name") ? place + "/" + gate.metric
              : several          ? table.string("name") + "/" + place
                                 : table.string("name");
  if (find_named(suite.gates, gate.name) != nullptr)
    throw table.error("there is a gate '" + gate.name + "' already; give this one a 'name'");
  read_statistics(table, gate);
  return gate;
}

/// One gate for each scene and engine of the row.
void add_gates(const TomlTable& table, GateSuite& suite, const Gate& defaults) {
  const auto scenes = named_rows("scene", "scenes", table, suite.scenes);
  const auto engines = named_rows("engine", "engines", table, suite.engines);
  const bool several = scenes.size() * engines.size() > 1;
  for (const SuiteScene* scene : scenes)
    for (const Engine* engine : engines)
      suite.gates.push_back(gate_from_toml(table, suite, defaults, *scene, *engine, several));
  table.expect_no_other_keys();
}

struct MutantName {
  std::string name;
};

Unpromised unpromised_from_toml(const TomlTable& table) {
  Unpromised row{table.string("planted"), table.string("why")};
  std::vector<MutantName> known;
  for (const GateVariant& variant : gate_variants())
    if (variant.is_mutant()) known.push_back({variant.name});
  if (find_named(known, row.planted) == nullptr)
    throw table.error("planted", unknown_name("planted fault", row.planted, known));
  table.expect_no_other_keys();
  return row;
}

}  // namespace

std::vector<const Gate*> gates_named(const GateSuite& suite, const std::string& part) {
  std::vector<const Gate*> chosen;
  std::vector<std::string> near;
  for (const Gate& gate : suite.gates) {
    if (gate.name.find(part) != std::string::npos) chosen.push_back(&gate);
    near.insert(near.end(), {gate.scene, gate.engine, gate.metric, gate.name});
  }
  if (chosen.empty())
    throw InputError("--only", "no gate of the suite has '" + part + "' in its name" + did_you_mean(part, near));
  return chosen;
}

GateSuite read_gate_suite(const std::filesystem::path& file) {
  const std::string text = read_file(file, max_suite_bytes);
  expect_required_keys(TomlTable::parse(text, file.string()));
  const TomlTable document = TomlTable::parse(text, file.string());
  GateSuite suite;
  suite.file = file;
  suite.folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  suite.name = file_name(document, "name");
  suite.title = document.string("title");
  suite.limits = limits_from_toml(document);
  if (suite.limits.threads == 0) suite.limits.threads = 1;  // images side by side use the cores better
  Gate defaults;
  defaults.alpha = 0.001;
  defaults.seeds = 8;
  defaults.looks = 4;
  read_statistics(document, defaults);
  suite.engines = builtin_engines();
  for (Engine& engine : engines_from_toml(document, suite.engines)) suite.engines.push_back(std::move(engine));
  for (const TomlTable& table : document.tables("scene")) {
    suite.scenes.push_back(scene_row(table, suite));
    table.expect_no_other_keys();
  }
  for (const TomlTable& table : document.tables("gate")) add_gates(table, suite, defaults);
  for (const TomlTable& table : document.tables("unpromised")) suite.unpromised.push_back(unpromised_from_toml(table));
  document.expect_no_other_keys();
  if (suite.gates.empty()) throw document.error("the suite has no [[gate]]");
  return suite;
}

}  // namespace photonproof::inline harness_gates
