// A benchmark suite: which scenes, which engines at which budgets and seeds, what each is compared with, and the
// limits. A TOML file, read strictly:
//   name, title
//   [limits]   seconds, memory_mb, threads (each optional)
//   [bench]    control = an engine whose cells are measured twice, the second time as "<engine>-control", to see
//              whether this session's times can be trusted (optional)
//   [[engine]] further engines, as in engines.toml
//   [[scene]]  name, path (relative to this file), width, height, exposure (optional),
//              reference = {engine, budget, seed}, rendered by the run itself, for example {engine = "reference",
//              budget = "standard-error=0.005", seed = 1} (optional; the stored one of this size, `photonproof
//              reference`); target_relmse (optional: the time to reach it is reported)
//   [[run]]    engine, budgets = ["spp=16", ...], seeds = [1, ...], scenes = [...] (optional; all of them)
// Seeds are the repetitions: two tell bias from noise, five give a time its interval.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/engines.h"
#include "harness/results.h"

namespace photonproof {

struct Limits {
  double seconds = 60;             ///< wall time of one cell
  std::uint64_t memory_mb = 2048;  ///< MiB, resident, of one cell's processes together
  int threads = 0;                 ///< that engines may use; 0: every core
};

struct SuiteScene {
  std::string name;
  std::filesystem::path path;  ///< openable from the current folder
  std::string given_path;      ///< as the suite says it
  int width = 0, height = 0;
  std::optional<double> exposure;   ///< stops; otherwise the scene's expect.toml says
  std::optional<Cell> reference{};  ///< empty: the stored one
  std::optional<double> target_relmse{};
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
  std::string control;      ///< name of the engine that is its own control; empty: none
  std::vector<Cell> cells;  ///< of the runs, in their order; references are not among them
};

/// Of the engine that measures `engine` a second time.
std::string control_name(const std::string& engine);

/// Throws InputError with file:line:col on anything but the above: unknown keys, wrong types, unknown engines and
/// scenes, budgets an engine does not accept, and cells that occur twice.
Suite read_suite(const std::filesystem::path& file);

/// "spp=64"; empty when the text is not a kind, '=' and a positive number.
std::optional<Budget> budget_from_text(const std::string& text);

}  // namespace photonproof
