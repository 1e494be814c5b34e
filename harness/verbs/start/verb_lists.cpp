// photonproof scenes, engines, metrics, suites: lists of what there is.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/images/engine_version.h"
#include "harness/metrics/metric_rows.h"
#include "harness/suites/engines.h"
#include "harness/suites/toml_table.h"
#include "harness/verbs/start/data_folder.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/json_text.h"
#include "scenes/description/expect.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs_start {
namespace {

namespace fs = std::filesystem;

/// A list: a name and what it is in words, and for JSON more members.
struct Listed {
  std::string name, words;
  nlohmann::ordered_json more{};
};

void print(const std::vector<Listed>& list, const std::string& last_line, bool json) {
  if (json) {
    auto array = nlohmann::ordered_json::array();
    for (const Listed& row : list) {
      nlohmann::ordered_json object{{"name", row.name}, {"description", row.words}};
      object.update(row.more);
      array.push_back(object);
    }
    std::printf("%s\n", json_text(array).c_str());
    return;
  }
  std::size_t width = 0;
  for (const Listed& row : list) width = std::max(width, row.name.size());
  for (const Listed& row : list)
    std::printf("%-*s  %s\n", static_cast<int>(width), row.name.c_str(), row.words.c_str());
  std::printf("%s\n", last_line.c_str());
}

/// Paths in a folder for which `wanted` holds, in the order of their names.
template <class Wanted>
std::vector<fs::path> sorted_entries(const fs::path& folder, const Wanted& wanted) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), none; !error && entry != none; entry.increment(error))
    if (wanted(entry->path())) paths.push_back(entry->path());
  std::ranges::sort(paths);
  return paths;
}

void list_scenes(bool json) {
  const fs::path data = data_folder();
  std::vector<Listed> list;
  for (const char* shelf : {"library", "showcase"})
    for (const fs::path& folder :
         sorted_entries(data / "scenes" / shelf, [](const fs::path& path) { return fs::exists(path / "scene.xml"); })) {
      const fs::path expect = folder / "expect.toml";
      const std::string purpose = fs::exists(expect) ? read_expect(expect.string()).purpose : "";
      list.push_back({folder.filename().string(), purpose, {{"path", (folder / "scene.xml").string()}}});
    }
  print(list,
        "render one: photonproof render " + (data / "scenes/library/cornell/scene.xml").string() + " -o cornell.png",
        json);
}

void list_engines(bool json) {
  const fs::path self = fs::read_symlink("/proc/self/exe");
  std::vector<Listed> list;
  for (const Engine& engine : builtin_engines()) {
    const EngineVersion version = ask_version(engine, fs::current_path(), self);
    const bool absent = version.problem && version.cells_end_as == Status::unsupported;
    const std::string state = absent            ? "not installed"
                              : version.problem ? "not usable: " + *version.problem
                                                : version.line;
    std::string budgets;
    for (const std::string& kind : engine.budget_kinds) budgets += (budgets.empty() ? "" : ", ") + kind;
    list.push_back({engine.name,
                    engine.title + " (" + to_string(engine.trust) + ", budgets " + budgets + "): " + state,
                    {{"trust", to_string(engine.trust)},
                     {"budgets", engine.budget_kinds},
                     {"usable", !version.problem},
                     {"version", version.problem ? nlohmann::ordered_json() : nlohmann::ordered_json(version.line)}}});
  }
  print(list, "a suite adds engines of its own by [[engine]] rows: photonproof init engine", json);
}

std::string words_of(BoundKind kind) {
  switch (kind) {
    case BoundKind::maximum:
      return "lower is better";
    case BoundKind::minimum:
      return "higher is better";
    case BoundKind::absolute_maximum:
      return "nearer to 0 is better";
  }
  return "";
}

void list_metrics(bool json) {
  std::vector<Listed> list;
  for (const MetricRow& row : metric_rows()) {
    std::string words = words_of(row.bound);
    if (row.on_request) words += "; on request";
    if (row.parameters != nullptr)
      if (const std::string parameters = row.parameters(); !parameters.empty()) words += "; depends on " + parameters;
    if (row.undefined_when != nullptr) words += "; undefined if " + std::string(row.undefined_when);
    list.push_back({row.name, words, {{"on_request", row.on_request}}});
  }
  print(list, "measure them: photonproof compare reference.exr test.exr", json);
}

void list_suites(bool json) {
  std::vector<Listed> list;
  const fs::path data = data_folder();
  for (const fs::path& file :
       sorted_entries(data / "harness/suites", [](const fs::path& path) { return path.extension() == ".toml"; })) {
    const TomlTable suite = TomlTable::parse(read_file(file), file.string());
    const std::string verb = suite.has("gate") ? "gate" : "bench";
    list.push_back(
        {suite.string("name"), verb + ": " + suite.string("title"), {{"verb", verb}, {"path", file.string()}}});
  }
  print(list, "run one: photonproof bench " + (data / "harness/suites/first-light.toml").string(), json);
}

void add_list(CLI::App& program, int& exit_code, const std::string& name, const std::string& purpose,
              void (*list)(bool)) {
  CLI::App* verb = add_verb(program, {.name = name,
                                      .group = start_group,
                                      .purpose = purpose,
                                      .examples = {"photonproof " + name},
                                      .exit_codes = {done, bad_input, internal_error},
                                      .page = "lists"});
  auto json = std::make_shared<bool>(false);
  begin_option_group(*verb, output_group);
  verb->add_flag("--json", *json, "print the list as JSON");
  verb->callback([json, list, &exit_code] {
    list(*json);
    exit_code = 0;
  });
}

}  // namespace

void add_list_verbs(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "scenes", "List the scenes that come with the program", list_scenes);
  add_list(program, exit_code, "engines", "List the engines, and which of them can be used here", list_engines);
  add_list(program, exit_code, "metrics", "List the metrics that compare and gates know", list_metrics);
  add_list(program, exit_code, "suites", "List the suites that come with the program", list_suites);
}

}  // namespace photonproof::inline harness_verbs_start
