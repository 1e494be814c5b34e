// A benchmark suite: which scenes, which engines at which budgets and seeds, what each is compared with, and the
// limits. Its keys are in suites/FORMAT.md, which suite_format_test.cpp holds to what is read here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/suites/engines.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_suites {

struct Limits {
  double seconds = 60;             ///< wall time of one cell
  std::uint64_t memory_mb = 2048;  ///< MiB, resident, of one cell's processes together; 0: no limit
  int threads = 0;                 ///< that engines may use; 0: every core
};

struct SuiteScene {
  std::string name;
  std::filesystem::path path;  ///< openable from the current folder
  std::string given_path;      ///< as the suite says it
  int width = 0, height = 0;
  std::optional<double> exposure;   ///< stops; otherwise the scene's expect.toml says
  std::optional<Cell> reference{};  ///< empty: the stored one
  std::vector<double> target_relmse{};
  std::map<std::string, std::filesystem::path> files{};  ///< what {scene} is instead of `path`, by engine

  const std::filesystem::path& file_for(const std::string& engine_name) const;
  /// What decides a cell of the engine beside the scene's own content: that of its file; empty without one. Throws
  /// InputError when it cannot be read.
  std::string file_content(const std::string& engine_name) const;
};

/// What benchmark suites and gate suites have in common.
struct SuiteCommon {
  std::filesystem::path file;
  std::filesystem::path folder;
  std::string name, title;
  Limits limits;
  std::vector<Engine> engines;
  std::vector<SuiteScene> scenes;

  const Engine& engine(const std::string& engine_name) const;    ///< precondition: it exists
  const SuiteScene& scene(const std::string& scene_name) const;  ///< precondition: it exists
};

struct Suite : SuiteCommon {
  std::string control;        ///< name of the engine that is its own control; empty: none
  Clock clock = Clock::wall;  ///< of curves of error against time
  std::vector<Cell> cells;    ///< of the runs, in their order; references are not among them
};

/// Of the engine that measures `engine` a second time.
std::string control_name(const std::string& engine);

/// Throws InputError with file:line:col on anything but the above: unknown keys, wrong types, unknown engines and
/// scenes, budgets an engine does not accept, and cells that occur twice.
Suite read_suite(const std::filesystem::path& file);

/// "spp=64"; empty when the text is not a kind, '=' and a positive number.
std::optional<Budget> budget_from_text(const std::string& text);

}  // namespace photonproof::inline harness_suites
