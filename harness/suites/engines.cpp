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

/// The key `denoise`: the command of this program's `render` gets the option, and the engine its marks. Precondition:
/// the row's other keys are read.
void read_denoise(const TomlTable& row, Engine& engine) {
  const std::vector<std::string>& command = engine.command;
  const bool renders = command.size() > 1 && command[0] == "{photonproof}" && command[1] == "render";
  const bool has_option = std::find(command.begin(), command.end(), "--denoise") != command.end();
  if (renders && has_option)
    throw row.error("command", "write denoise = true in place of --denoise, so that reports and gates know of it");
  if (!row.has("denoise") || !row.boolean("denoise")) return;
  if (!renders) throw row.error("denoise", "'denoise' is of commands that begin with {photonproof} render");
  if (engine.trust != Trust::biased)
    throw row.error("trust", "an engine that denoises is biased; 'trust' must be \"biased\"");
  engine.denoises = true;
  engine.title += " (denoised, biased)";
  engine.command.emplace_back("--denoise");
  engine.version_commands.push_back({"{photonproof}", "denoiser"});
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
  read_denoise(row, engine);
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
