#include "harness/suites/engines.h"

#include <algorithm>

#include "engines_text.h"
#include "harness/suites/engine_command.h"
#include "scenes/base/edit_distance.h"

namespace photonproof::inline harness_suites {
namespace {

Trust trust_from_toml(const TomlTable& row) {
  const std::string name = row.string("trust");
  for (const Trust trust : {Trust::unbiased, Trust::biased, Trust::external})
    if (name == to_string(trust)) return trust;
  throw row.error("trust", "'trust' is one of unbiased, biased, external; not '" + name + "'" +
                               did_you_mean(name, {"unbiased", "biased", "external"}));
}

// Names become folder names, labels and HTML ids.
void check_name(const TomlTable& row, const std::string& name) {
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") != std::string::npos)
    throw row.error("name", "'name' may hold letters, digits, '_', '.' and '-'; not '" + name + "'");
}

Engine engine_from_toml(const TomlTable& row) {
  Engine engine;
  engine.name = row.string("name");
  check_name(row, engine.name);
  engine.title = row.string("title");
  engine.command = row.strings("command");
  if (const auto problem = command_problem(engine.command, CommandUse::render)) throw row.error("command", *problem);
  if (row.has("versions")) engine.version_commands = row.string_lists("versions");
  for (const auto& command : engine.version_commands)
    if (const auto problem = command_problem(command, CommandUse::version)) throw row.error("versions", *problem);
  engine.budget_kinds = row.strings("budgets");
  if (engine.budget_kinds.empty()) throw row.error("budgets", "'budgets' must name at least one kind");
  engine.trust = trust_from_toml(row);
  if (row.has("image")) engine.image_extension = row.string("image");
  if (row.has("layer")) engine.layer = row.string("layer");
  if (!engine.layer.empty() && engine.image_extension != "exr")
    throw row.error("layer", "'layer' is of an EXR; the engine's 'image' is '" + engine.image_extension + "'");
  row.expect_no_other_keys();
  return engine;
}

}  // namespace

std::string to_string(Trust trust) {
  switch (trust) {
    case Trust::unbiased:
      return "unbiased";
    case Trust::biased:
      return "biased";
    case Trust::external:
      break;
  }
  return "external";
}

bool Engine::accepts(const std::string& budget_kind) const {
  return std::find(budget_kinds.begin(), budget_kinds.end(), budget_kind) != budget_kinds.end();
}

std::vector<Engine> builtin_engines() {
  const TomlTable document = TomlTable::parse(engines_text, "engines.toml");
  std::vector<Engine> engines = engines_from_toml(document, {});
  document.expect_no_other_keys();
  return engines;
}

Engine own_row(const std::string& integrator) {
  Engine row;
  row.name = integrator.empty() ? "photonproof" : integrator;
  row.command = {"{photonproof}", "render",          "{scene}",          "-o",      "{output}", "--stats",
                 "{stats}",       "--size",          "{width}x{height}", "--seed",  "{seed}",   "--threads",
                 "{threads}",     "--allow-outside", "--quiet",          "{budget}"};
  if (!integrator.empty()) row.command.insert(row.command.end(), {"--integrator", integrator});
  row.budget_kinds = {"spp"};
  return row;
}

std::vector<Engine> engines_from_toml(const TomlTable& document, const std::vector<Engine>& existing) {
  std::vector<Engine> engines;
  for (const TomlTable& row : document.tables("engine")) {
    Engine engine = engine_from_toml(row);
    const auto same_name = [&](const Engine& other) { return other.name == engine.name; };
    if (std::any_of(engines.begin(), engines.end(), same_name) ||
        std::any_of(existing.begin(), existing.end(), same_name))
      throw row.error("name", "there is an engine '" + engine.name + "' already");
    engines.push_back(std::move(engine));
  }
  return engines;
}

}  // namespace photonproof::inline harness_suites
