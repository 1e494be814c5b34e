// A benchmark suite: its scenes, engines, budgets and seeds, the reference of each scene, and the limits. Its keys are
// in docs/formats/suite.md; suite_format_test.cpp checks that the page and this reader agree.
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
  int threads = 0;                 ///< for the engine to use; 0: every core
};

/// The program that reads a scene.
enum class SceneReader {
  photonproof,    ///< this program, too: an XML of our subset
  engine,         ///< the engine alone; `path` is a file or folder of any format
  engine_by_word  ///< the engine alone; `path` is no file but a word or number that it knows
};

struct SuiteScene {
  std::string name;
  std::filesystem::path path;  ///< openable from the current folder, or a word
  std::string given_path;      ///< as written in the suite
  int width = 0, height = 0;
  std::optional<double> exposure;   ///< stops; without it the scene's expect.toml gives the exposure
  std::optional<Cell> reference{};  ///< empty: the stored one
  std::vector<double> target_relmse{};
  std::map<std::string, std::filesystem::path> files{};  ///< by engine: what {scene} is instead of `path`
  SceneReader reader = SceneReader::photonproof;
  std::filesystem::path suite_file{};  ///< the suite that has this row

  bool is_opaque() const { return reader != SceneReader::photonproof; }
  const std::filesystem::path& file_for(const std::string& engine_name) const;
  /// Content of the engine's own file for the scene, which its cells depend on besides the scene itself; empty without
  /// one. Throws InputError when it cannot be read.
  std::string file_content(const std::string& engine_name) const;
};

/// Common part of benchmark suites and gate suites.
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
  Clock clock = Clock::wall;  ///< for curves of error against time
  std::vector<Cell> cells;    ///< of the runs, in their order, without references
};

/// Name of the engine that measures `engine` a second time.
std::string control_name(const std::string& engine);

/// Throws InputError with file:line:col on unknown keys, wrong types, unknown engines and scenes, budgets an engine
/// does not accept, and cells that occur twice.
Suite read_suite(const std::filesystem::path& file);

/// "spp=64"; empty when the text is not a kind, '=' and a positive number.
std::optional<Budget> budget_from_text(const std::string& text);

}  // namespace photonproof::inline harness_suites
