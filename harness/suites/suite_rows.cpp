#include "harness/suites/suite_rows.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>

#include "harness/suites/engine_command.h"
#include "scenes/parser/parser.h"

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

namespace {

namespace fs = std::filesystem;

struct RequiredKeys {
  const char* table;                           ///< empty: the document itself
  std::vector<std::vector<std::string>> keys;  ///< one of each list
};

const std::array<RequiredKeys, 6> required_keys{
    {{"", {{"name"}, {"title"}}},
     {"engine", {{"name"}, {"title"}, {"command"}, {"budgets"}, {"trust"}}},
     {"scene", {{"name"}, {"path"}}},
     {"run", {{"engine", "engines"}, {"budgets"}, {"seeds"}}},
     {"gate", {{"scene", "scenes"}, {"engine", "engines"}, {"budget"}, {"metric"}, {"bound"}}},
     {"unpromised", {{"planted"}, {"why"}}}}};

/// "'title', 'budgets'", of the keys that the table lacks.
std::vector<std::string> missing_keys(const TomlTable& table, const RequiredKeys& required) {
  const std::vector<std::string> given = table.keys();
  std::vector<std::string> missing;
  for (const std::vector<std::string>& one_of : required.keys)
    if (std::ranges::none_of(one_of, [&](const auto& key) { return std::ranges::find(given, key) != given.end(); }))
      missing.push_back("'" + one_of.front() + "'");
  return missing;
}

/// Whether the engine is said to be the scene's only reader. Throws InputError for any other value.
bool is_said_to_be_the_engines(const TomlTable& table) {
  if (!table.has("reads")) return false;
  if (const std::string reader = table.string("reads"); reader != "engine")
    throw table.error("reads", "'reads' is \"engine\", where only the engine reads the scene; not '" + reader + "'");
  return true;
}

/// Whether a file is to be parsed, so that a mistake in it is reported: it is called XML or PBRT, or begins as a scene
/// does.
bool may_be_ours(const fs::path& file) {
  if (file.extension() == ".xml" || file.extension() == ".pbrt") return true;
  std::string beginning(1024, '\0');
  std::ifstream(file, std::ios::binary).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return beginning.find("<scene") != std::string::npos;
}

constexpr std::size_t longest_word = 64;  // of one that a message proposes

void read_path(const TomlTable& table, const SuiteCommon& suite, SuiteScene& scene) {
  const bool engines = is_said_to_be_the_engines(table);
  if (table.has("path") && table.is_integer("path")) {
    scene.given_path = std::to_string(table.integer("path"));
    scene.path = scene.given_path;
    scene.reader = SceneReader::engine_by_word;
    return;
  }
  scene.given_path = table.string("path");
  const fs::path file = (suite.folder / scene.given_path).lexically_normal();
  std::error_code unreachable;  // for example, of a name that is too long
  const bool is_word = scene.given_path.find_first_of("/.") == std::string::npos && !fs::exists(file, unreachable);
  if (fs::is_directory(file, unreachable) ||
      (fs::is_regular_file(file, unreachable) && (engines || !may_be_ours(file)))) {
    scene.path = file;
    scene.reader = SceneReader::engine;
  } else if (engines && is_word) {
    scene.path = scene.given_path;
    scene.reader = SceneReader::engine_by_word;
  } else if (!engines && is_word && scene.given_path.size() < longest_word) {
    throw table.error("path", "no such file: " + file.string() +
                                  "; reads = \"engine\" beside it makes it a word that only the engine reads");
  } else {
    scene.path = existing_file(table, "path", suite.folder);
  }
}

/// The size of our own scene's film, or the usual one.
void read_size(const TomlTable& table, SuiteScene& scene) {
  scene.width = scene.height = usual_side;
  if (!scene.is_opaque() && !(table.has("width") && table.has("height"))) {
    try {
      const FilmDescription film = parse_scene_file(scene.path.string()).sensor.film;
      scene.width = film.width;
      scene.height = film.height;
    } catch (const InputError& error) {
      throw with_reader_advice(error, scene.name, scene.suite_file);
    }
  }
  if (table.has("width")) scene.width = bounded_integer(table, "width", 1, max_side);
  if (table.has("height")) scene.height = bounded_integer(table, "height", 1, max_side);
}

}  // namespace

void expect_required_keys(const TomlTable& document) {
  std::string all;
  std::size_t count = 0;
  const auto check = [&](const TomlTable& table, const RequiredKeys& required) {
    const std::vector<std::string> missing = missing_keys(table, required);
    if (missing.empty()) return;
    count += missing.size();
    std::string names;
    for (const std::string& key : missing) names += (names.empty() ? "" : ", ") + key;
    all +=
        (all.empty() ? "" : "; ") + names + " of " +
        (*required.table == '\0' ? "the suite"
                                 : "[[" + std::string(required.table) + "]] in line " + std::to_string(table.line()));
  };
  for (const RequiredKeys& required : required_keys) {
    if (*required.table == '\0')
      check(document, required);
    else
      for (const TomlTable& table : document.tables(required.table)) check(table, required);
  }
  if (count > 1) throw document.error("these keys are missing: " + all);
}

InputError with_reader_advice(const InputError& error, const std::string& scene_name, const fs::path& suite_file) {
  const std::string text = error.summary(), separator = ": error: ";
  const std::size_t at = text.find(separator);
  return {text.substr(0, at), text.substr(at + separator.size()) +
                                  "; if only the engine is to read this file, write reads = \"engine\" in [[scene]] '" +
                                  scene_name + "' of " + suite_file.string()};
}

void expect_readable(const TomlTable& table, const std::string& key, const SuiteScene& scene, const Engine& engine) {
  if (!scene.is_opaque() || engine.command.front() != "{photonproof}" || scene.files.contains(engine.name)) return;
  throw table.error(key, "engine '" + engine.name + "' is part of this program, which cannot read scene '" +
                             scene.name + "' (" + scene.given_path + "); name an [[engine]] that reads it");
}

SuiteScene scene_row(const TomlTable& table, const SuiteCommon& suite) {
  SuiteScene scene;
  scene.name = file_name(table, "name");
  if (find_named(suite.scenes, scene.name) != nullptr)
    throw table.error("name", "there is a scene '" + scene.name + "' already");
  scene.suite_file = suite.file;
  read_path(table, suite, scene);
  if (table.has("files")) {
    const TomlTable files = table.table("files");
    for (const std::string& engine : files.keys()) {
      if (find_named(suite.engines, engine) == nullptr)
        throw files.error(engine, unknown_name("engine", engine, suite.engines));
      scene.files[engine] = existing_file(files, engine, suite.folder);
    }
  }
  read_size(table, scene);
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
