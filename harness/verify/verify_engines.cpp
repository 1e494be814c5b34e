#include "harness/verify/verify_engines.h"

#include <algorithm>

#include "harness/gates/independence.h"
#include "harness/suites/suite_rows.h"
#include "scenes/text/atomic_file.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

/// Of engines.toml. sppm is the photon mapper's code with other settings, and `reference` is one of the others.
constexpr const char* kVerifying[] = {"path", "bdpt", "ptracer", "volpath", "photonmapper", "povray"};

std::vector<Engine> rows_of(const fs::path& file, const std::vector<Engine>& builtin) {
  if (file.empty()) return {};
  const TomlTable document = TomlTable::parse(read_file(file, max_suite_bytes), file.string());
  return engines_from_toml(document, builtin);  // a suite's other tables are not ours to judge
}

/// Variance layers of stratified samples say too much (harness/statistics/agreement.h), and scenes with a part of their
/// light lie elsewhere than their textures.
void complete_command(Engine& row) {
  if (row.command.empty() || row.command.front() != "{photonproof}" || row.command.size() < 2) return;
  if (row.command[1] == "render")
    row.command.insert(row.command.end(), {"--sampler", "independent", "--allow-outside"});
  if (row.command[1] == "povray") row.command.push_back("--allow-outside");
}

std::string sampling_of_row(const Engine& row) {
  const std::optional<std::string> integrator = integrator_of(row);
  return integrator ? sampling_of(*integrator) : row.name;
}

VerifyEngine verifying(Engine row, const fs::path& folder, const fs::path& program) {
  VerifyEngine engine;
  engine.sampling = sampling_of_row(row);
  engine.is_ours = integrator_of(row).has_value();
  engine.budget_kind = row.accepts("spp") ? "spp" : row.budget_kinds.front();
  engine.version = ask_version(row, folder, program);
  complete_command(row);
  engine.row = std::move(row);
  return engine;
}

}  // namespace

std::vector<VerifyEngine> verify_engines(const EngineChoice& choice) {
  const std::vector<Engine> builtin = builtin_engines();
  std::vector<Engine> rows;
  for (const char* name : kVerifying) rows.push_back(*find_named(builtin, name));
  for (Engine& row : rows_of(choice.rows, builtin)) rows.push_back(std::move(row));
  for (const std::string& name : choice.names)
    if (find_named(rows, name) == nullptr) throw InputError("--engine", unknown_name("engine", name, rows));
  const fs::path folder = choice.rows.empty() ? fs::path(".") : fs::absolute(choice.rows).parent_path();
  std::vector<VerifyEngine> engines;
  for (Engine& row : rows)
    if (choice.names.empty() || std::ranges::find(choice.names, row.name) != choice.names.end())
      engines.push_back(verifying(std::move(row), folder, choice.program));
  return engines;
}

}  // namespace photonproof
