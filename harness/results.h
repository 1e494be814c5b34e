// The record of a benchmark run: one Result a cell, with the suite, host and versions it was made with. results.json is
// this record; the schema beside it (results.schema.json) is its contract. Everything after it (reports, gates) is a
// view.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof {

inline constexpr int results_schema_version = 1;

/// What ended a cell. Anything but `ok` leaves metrics empty and `detail` saying why in one sentence.
enum class Status { ok, timeout, crash, bad_image, unsupported };
std::string to_string(Status status);
/// Throws InputError on an unknown name.
Status status_from_string(const std::string& name);

/// A budget is a kind ("spp", "photons", "seconds", "quality") and its amount.
struct Budget {
  std::string kind;
  double amount = 0;
  std::string amount_text() const;  ///< "64", "0.5": exact, and whole numbers without an exponent
  std::string label() const;        ///< "spp=64"
  friend bool operator==(const Budget&, const Budget&) = default;
};

struct Cell {
  std::string scene;
  std::string engine;
  Budget budget;
  std::uint64_t seed = 0;
  std::string label() const;  ///< "cornell/path/spp=64/seed=1": unique within a run, also names its files
};

/// A metric's parameters travel with its number.
struct MetricValue {
  std::string name;
  double value = 0;
  std::string parameters;  ///< e.g. "exposure=0, sigma=1.5", empty when it has none
};

struct Result {
  Cell cell;
  std::string
      key;  ///< content hash of everything that decides the outcome (scene, engine, version, budget, seed, limits)
  Status status = Status::ok;
  std::string detail;                           ///< why, when not ok: one sentence
  std::optional<double> wall_seconds;           ///< of the child process
  std::optional<double> cpu_seconds;            ///< user + system, of the child and its children
  std::optional<std::uint64_t> peak_bytes;      ///< peak resident set
  std::vector<MetricValue> metrics;             ///< against the scene's reference; empty for the reference itself
  std::string image;                            ///< EXR, relative to results.json; empty when there is none
  std::map<std::string, std::string> pictures;  ///< PNGs relative to results.json by role: "image", "flip", "error"
  std::map<std::string, double> phases;  ///< seconds by phase as the engine reports them ("render", "photons" ...)
  std::map<std::string, double> counts;  ///< rays, photons ... as the engine reports them
  std::vector<std::string> skipped;      ///< passes the engine skipped, with the reason
  std::string engine_version;
  std::string command;               ///< how to repeat it, as one would type it
  std::vector<std::string> caveats;  ///< e.g. "host was busy (load 3.1)"
};

struct SceneRecord {
  std::string name;
  std::string path;     ///< as given in the suite
  std::string purpose;  ///< one sentence from expect.toml
  int width = 0, height = 0;
  double exposure = 0;          ///< stops; for every display-referred metric and picture
  std::string reference_label;  ///< Cell::label of the Result that serves as the reference
};

struct EngineRecord {
  std::string name;
  std::string title;  ///< "photonproof path tracer"
  std::string version;
  std::string trust{};  ///< "unbiased", "biased" or "external" (harness/engines.h); empty when the record does not say
};

struct Host {
  std::string cpu, os, kernel;
  int cores = 0;
  std::uint64_t memory_bytes = 0;
};

struct Results {
  std::string suite;
  std::string created;  ///< UTC, ISO 8601
  std::string command;  ///< how the whole run is repeated
  Host host;
  std::map<std::string, std::string> versions;  ///< of libraries: "embree": "3.13.5", ...
  std::vector<SceneRecord> scenes;
  std::vector<EngineRecord> engines;
  std::vector<Result> results;  ///< references included

  const Result* find(const std::string& cell_label) const;
};

/// Validated against the schema first; throws InputError naming file and JSON pointer, also when two results are of the
/// same cell.
Results read_results(const std::string& path);
/// Atomic: written beside and renamed. Validates what it writes; a number that is not finite is a std::logic_error.
void write_results(const std::string& path, const Results& results);

/// One result alone, as a cell's folder keeps it; its paths are relative to the run's results.json.
struct KeptResult {
  Result result;
  std::string comparison_key;  ///< content hash of what the metrics and pictures were made with; empty before they are
};
/// The same checks as for a whole run.
KeptResult read_result(const std::string& path);
void write_result(const std::string& path, const KeptResult& kept);

}  // namespace photonproof
