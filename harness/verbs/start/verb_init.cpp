// photonproof init: writes a folder to begin with: a gate in CI, a table of error against time, a course, an engine.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/verbs/start/data_folder.h"
#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_verbs_start {
namespace {

namespace fs = std::filesystem;

/// A file or folder of the data folder, and its place in the new folder.
struct Part {
  std::string from, to;
};

const std::map<std::string, std::vector<Part>>& kinds() {
  static const std::map<std::string, std::vector<Part>> all{
      {"ci",
       {{"harness/init/ci/README.md", "README.md"},
        {"harness/init/ci/gates.toml", "gates.toml"},
        {"harness/ci/github-actions.yml", ".github/workflows/photonproof.yml"},
        {"scenes/library/cornell", "scenes/cornell"}}},
      {"table",
       {{"harness/init/table/README.md", "README.md"},
        {"harness/init/table/table.toml", "table.toml"},
        {"scenes/library/cornell", "scenes/cornell"},
        {"scenes/library/cornell-spheres", "scenes/cornell-spheres"}}},
      {"course",
       {{"harness/init/course/README.md", "README.md"},
        {"harness/courses/photon-mapping/assignment.toml", "assignment.toml"},
        {"harness/courses/photon-mapping/handout", "handout"},
        {"harness/courses/photon-mapping/staff", "staff"},
        {"harness/courses/photon-mapping/scenes", "scenes"}}},
      {"engine",
       {{"harness/init/engine/README.md", "README.md"},
        {"harness/suites/foreign/ball.cpp", "ball.cpp"},
        {"harness/suites/foreign/ball.toml", "gates.toml"},
        {"harness/suites/foreign/two-balls.balls", "two-balls.balls"}}},
  };
  return all;
}

void copy_part(const fs::path& data, const Part& part, const fs::path& folder) {
  fs::create_directories((folder / part.to).parent_path());
  fs::copy(data / part.from, folder / part.to, fs::copy_options::recursive);
}

/// Fills a folder beside the final one and renames it, so that a failure leaves nothing.
void write_folder(const std::string& kind, const fs::path& folder) {
  if (fs::exists(folder)) throw InputError(folder.string(), "already exists: name another folder with -o");
  const fs::path data = data_folder(), parent = fs::absolute(folder).lexically_normal().parent_path();
  fs::create_directories(parent);
  const fs::path unfinished = parent / ("." + folder.filename().string() + "." + std::to_string(getpid()));
  try {
    for (const Part& part : kinds().at(kind)) copy_part(data, part, unfinished);
    fs::rename(unfinished, folder);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw;
  }
}

}  // namespace

void add_init_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb = add_verb(program, {.name = "init",
                                      .group = start_group,
                                      .purpose = "Write a folder to begin with: for ci, a table, a course or an engine",
                                      .examples = {"photonproof init ci -o my-gates", "photonproof init table"},
                                      .exit_codes = {done, bad_input, internal_error}});
  auto kind = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const auto& [name, parts] : kinds()) names.push_back(name);
  begin_option_group(*verb, input_group);
  verb->add_option("kind", *kind, "ci, course, engine or table")->required()->check(one_of(names));
  begin_option_group(*verb, output_group);
  verb->add_option("-o,--output", *folder, "new folder (default: photonproof-KIND)");
  verb->callback([kind, folder, &exit_code] {
    const fs::path target = fs::path(folder->empty() ? "photonproof-" + *kind : *folder) / "";
    write_folder(*kind, target.parent_path());
    std::printf("%s: begin with README.md\n", target.parent_path().c_str());
    exit_code = 0;
  });
}

}  // namespace photonproof::inline harness_verbs_start
