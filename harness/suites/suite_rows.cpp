#include "harness/suites/suite_rows.h"

#include <system_error>

namespace photonproof::inline harness_suites {

int bounded_integer(const TomlTable& table, const std::string& key, std::int64_t least, std::int64_t most) {
  const std::int64_t value = table.integer(key);
  if (value < least || value > most)
    throw table.error(key, "'" + key + "' must lie between " + std::to_string(least) + " and " + std::to_string(most));
  return static_cast<int>(value);
}

std::string file_name(const TomlTable& table, const std::string& key) {
  std::string name = table.string(key);
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") !=
          std::string::npos ||
      name.front() == '.')
    throw table.error(key, "'" + key + "' may hold letters, digits, '_', '.' and '-' and not start with '.'");
  return name;
}

Limits limits_from_toml(const TomlTable& document) {
  Limits limits;
  if (!document.has("limits")) return limits;
  const TomlTable table = document.table("limits");
  if (table.has("seconds")) limits.seconds = table.number("seconds");
  if (limits.seconds <= 0) throw table.error("seconds", "'seconds' must be positive");
  if (table.has("memory_mb"))
    limits.memory_mb = static_cast<std::uint64_t>(bounded_integer(table, "memory_mb", 1, 1 << 30));
  if (table.has("threads")) limits.threads = bounded_integer(table, "threads", 1, 1024);
  table.expect_no_other_keys();
  return limits;
}

std::filesystem::path existing_file(const TomlTable& table, const std::string& key,
                                    const std::filesystem::path& folder) {
  std::filesystem::path file = (folder / table.string(key)).lexically_normal();
  std::error_code unreachable;  // for example, of a name that is too long
  if (!std::filesystem::is_regular_file(file, unreachable)) throw table.error(key, "no such file: " + file.string());
  return file;
}

SuiteScene scene_row(const TomlTable& table, const SuiteCommon& suite) {
  SuiteScene scene;
  scene.name = file_name(table, "name");
  if (find_named(suite.scenes, scene.name) != nullptr)
    throw table.error("name", "there is a scene '" + scene.name + "' already");
  scene.given_path = table.string("path");
  scene.path = existing_file(table, "path", suite.folder);
  if (table.has("files")) {
    const TomlTable files = table.table("files");
    for (const std::string& engine : files.keys()) {
      if (find_named(suite.engines, engine) == nullptr)
        throw files.error(engine, unknown_name("engine", engine, suite.engines));
      scene.files[engine] = existing_file(files, engine, suite.folder);
    }
  }
  scene.width = bounded_integer(table, "width", 1, max_side);
  scene.height = bounded_integer(table, "height", 1, max_side);
  if (table.has("exposure")) scene.exposure = table.number("exposure");
  return scene;
}

const Engine& known_engine(const TomlTable& table, const std::vector<Engine>& engines) {
  const std::string name = table.string("engine");
  const Engine* engine = find_named(engines, name);
  if (engine == nullptr) throw table.error("engine", unknown_name("engine", name, engines));
  return *engine;
}

std::optional<std::string> budget_problem(const std::string& text, const Engine& engine) {
  const std::optional<Budget> budget = budget_from_text(text);
  if (!budget) return "a budget is written \"kind=amount\" with a positive amount, not '" + text + "'";
  if (engine.accepts(budget->kind)) return std::nullopt;
  std::string kinds;
  for (const std::string& kind : engine.budget_kinds) kinds += (kinds.empty() ? "" : ", ") + kind;
  return "engine '" + engine.name + "' takes budgets of " + kinds + "; not '" + budget->kind + "'" +
         did_you_mean(budget->kind, engine.budget_kinds);
}

}  // namespace photonproof::inline harness_suites
