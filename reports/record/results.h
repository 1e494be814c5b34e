// The record of a benchmark run: one Result a cell, with the suite, host and versions it was made with. results.json is
// this record; the schema beside it (results.schema.json) is its contract. Everything after it (reports, gates) is a
// view.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/images/exposure_range.h"

namespace photonproof::inline reports_record {

inline constexpr int results_schema_version = 1;

/// What ended a cell. Anything but `ok` leaves metrics empty and `detail` saying why in one sentence.
enum class Status { ok, timeout, crash, bad_image, unsupported, not_started };
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

/// How caveats begin that are an engine's own.
inline constexpr const char* declared_by_engine = "declared by the engine: ";

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

/// Ends of a 95 % confidence interval, unless its owner says otherwise.
struct Interval {
  double low = 0, high = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A number and what is known of its uncertainty.
struct Estimate {
  double value = 0;
  std::optional<Interval> interval;
  friend bool operator==(const Estimate&, const Estimate&) = default;
};

/// How long the harness' own calibration workload took beside a cell (harness/cells/calibration.h).
struct CalibrationReading {
  std::string workload;  ///< which one, and by which compiler; readings of others do not compare
  int threads = 1;       ///< that did it at the same time
  double seconds = 0;    ///< processor time of one thread, the mean of the readings before and after the cell
  friend bool operator==(const CalibrationReading&, const CalibrationReading&) = default;
};

struct Result {
  Cell cell;
  std::string
      key;  ///< content hash of everything that decides the outcome (scene, engine, version, budget, seed, limits)
  Status status = Status::ok;
  std::string detail;                         ///< why, when not ok: one sentence
  std::optional<double> wall_seconds;         ///< of the child process
  std::optional<double> cpu_seconds;          ///< user + system, of the child and its children
  std::optional<std::uint64_t> peak_bytes;    ///< peak resident set
  std::optional<std::uint64_t> instructions;  ///< retired in user mode, where the kernel counts them
  std::optional<CalibrationReading> calibration{};
  std::vector<MetricValue> metrics;  ///< against the scene's reference; empty for the reference itself
  std::string image;                 ///< EXR, relative to results.json; empty when there is none
  std::string
      image_checksum{};  ///< of the image's file (scenes/files/file_checksum.h); empty in records of before it was kept
  std::map<std::string, std::string> pictures;  ///< PNGs relative to results.json by role: "image", "flip", "error"
  std::map<std::string, double> phases;  ///< seconds by phase as the engine reports them ("render", "photons" ...)
  std::map<std::string, double> counts;  ///< rays, photons ... as the engine reports them
  std::vector<std::string> skipped;      ///< passes the engine skipped, with the reason
  std::string engine_version;
  std::string command;               ///< how to repeat it, as one would type it
  std::vector<std::string> caveats;  ///< e.g. "host was busy (load 3.1)", or declared_by_engine and one of its losses
};

/// A stored reference that a scene was compared with, and where it came from.
struct ReferenceRecord {
  std::string file;                               ///< as opened
  std::string image;                              ///< a copy, relative to results.json; empty when there is none
  std::string picture;                            ///< PNG, relative to results.json; empty when there is none
  std::map<std::string, std::string> provenance;  ///< "estimator", "samples", "standard_error", "scene_hash", ...
  friend bool operator==(const ReferenceRecord&, const ReferenceRecord&) = default;
};

struct SceneRecord {
  std::string name;
  std::string path;     ///< as given in the suite
  std::string purpose;  ///< one sentence from expect.toml
  int width = 0, height = 0;
  double exposure = 0;          ///< stops; for every display-referred metric and picture
  std::string reference_label;  ///< Cell::label of the Result that serves as the reference; empty when one is stored
  std::optional<ReferenceRecord> reference{};    ///< the stored one
  std::optional<ExposureRange> hdr_exposures{};  ///< of hdr_flip, which is computed where they are pinned
  /// Why errors against the reference are not errors: "the reference is by photonmapper, which is biased". Empty where
  /// it may be believed.
  std::string reference_doubt{};
};

struct EngineRecord {
  std::string name;
  std::string title;  ///< "photonproof path tracer"
  std::string version;
  std::string
      trust{};  ///< "unbiased", "biased" or "external" (harness/suites/engines.h); empty when the record does not say
};

struct Host {
  std::string cpu, os, kernel;
  int cores = 0;
  std::uint64_t memory_bytes = 0;
};

/// Whether images show what they should: they agree with the reference, and a small error would have been seen; nothing
/// is seen, but a large error could hide; they differ by more than noise explains; nothing can be said.
enum class Correctness { right, noisy, biased, unknown };
std::string to_string(Correctness correctness);

/// The verdict on a budget's images, by the gates' statistics (harness/bench/correctness.h).
struct CorrectnessRecord {
  Correctness verdict = Correctness::unknown;
  std::string sentence;  ///< where and how large, or why nothing can be said
  std::optional<Estimate>
      whole;  ///< relative error of the whole image in its worst channel; its interval is the test's
  /// Where right: the relative error of the whole image, and of a block of 8 x 8 pixels, that would have been seen with
  /// probability 0.99.
  std::optional<double> would_see, would_see_in_a_block;
  std::string regression_only{};  ///< as GateRecord's
  friend bool operator==(const CorrectnessRecord&, const CorrectnessRecord&) = default;
};

/// Why a number is not there, by its name in results.json: {"slope": "two budgets"}.
using Reasons = std::map<std::string, std::string>;

/// What times a curve: wall time of the engine's process, or processor time of all its threads.
enum class Clock { wall, processor };
std::string to_string(Clock clock);
std::optional<Clock> clock_from_string(const std::string& name);
/// Of a cell, if it was measured.
std::optional<double> seconds_by(Clock clock, const Result& result);

/// One budget of an engine on a scene, over its seeds.
struct CurvePoint {
  Budget budget;
  int seeds = 0;                     ///< finished cells
  Estimate seconds;                  ///< median, by the curve's clock
  std::optional<Estimate> relmse;    ///< mean; absent without a reference
  std::optional<Estimate> bias2;     ///< relative, as relmse; where its interval excludes 0
  std::optional<Estimate> variance;  ///< relative, of one image; needs two seeds
  std::optional<CorrectnessRecord> correctness{};
  Reasons undefined{};
  friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

/// When an engine's error comes down to one that the suite asks for.
struct TargetTime {
  double relmse = 0;
  std::optional<Estimate> seconds{};  ///< interpolated between measured budgets, never beyond them
  /// Where there is none: what it must take, the seconds of the largest budget, or of the smallest, whose errors are
  /// still above, already below the target.
  std::optional<double> more_than{}, at_most{};
  std::string undefined{};  ///< why nothing is known of the time; empty where something is
  friend bool operator==(const TargetTime&, const TargetTime&) = default;
};

/// Error against time of one engine on one scene (METRICS in README).
struct Convergence {
  std::string scene, engine;
  Clock clock = Clock::wall;
  std::vector<CurvePoint> points;      ///< of one kind of budget, ascending
  std::optional<Estimate> slope;       ///< least squares of log relmse on log seconds
  std::optional<Estimate> efficiency;  ///< 1/(relmse seconds) at the largest budget
  std::vector<TargetTime> targets{};   ///< of the scene, as the suite states them
  std::vector<std::string> caveats;
  Reasons undefined{};
  friend bool operator==(const Convergence&, const Convergence&) = default;
};

/// How long each engine took on a scene to come down to one error, which most of them reach between two budgets.
struct RaceRecord {
  struct Time {
    std::string engine;
    double seconds = 0;      ///< interpolated between its budgets, or a bound
    bool at_most = false;    ///< its smallest budget is below that error already: it may need less
    bool more_than = false;  ///< its largest budget is still above that error: it needs more
    bool unranked = false;   ///< a bound that leaves open which engine is faster
    friend bool operator==(const Time&, const Time&) = default;
  };
  std::string scene;
  double relmse = 0;
  std::vector<Time> times;  ///< fastest first, then those without a rank
  friend bool operator==(const RaceRecord&, const RaceRecord&) = default;
};

enum class GateVerdict { pass, fail, inconclusive };
std::string to_string(GateVerdict verdict);

/// A part of an image where a gate failed, in pixels, row 0 on top.
struct FailingTile {
  int x = 0, y = 0, width = 0, height = 0;
  /// Tiles rank by it: how far beyond what noise explains, in standard errors; of gates on a metric of `compare` the
  /// tile's share of the error.
  double score = 0;
  std::string sentence;  ///< "+6 % at the floor's contact, 41 px"
  friend bool operator==(const FailingTile&, const FailingTile&) = default;
};

/// What one gate decided.
struct GateRecord {
  std::string name;  ///< unique within a run
  std::string scene, engine, metric;
  GateVerdict verdict = GateVerdict::inconclusive;
  std::string sentence;  ///< where and how
  /// What became of the engine where it left no image to be judged: the verdict is about that, not about images.
  std::optional<Status> status{};
  std::optional<Estimate> observed;
  std::optional<double> bound;
  /// Of an agreement gate that passes: the relative error of the whole image, and of a block of 8 x 8 pixels, that it
  /// would have seen with probability 0.99.
  std::optional<double> would_see, would_see_in_a_block;
  /// Why the gate can only notice changes: the engine's own estimator made the reference. Empty: it can convict.
  std::string regression_only;
  /// When the verdict was decided (UTC, ISO 8601), where not by this run: its images are those of that verdict.
  std::string accepted{};
  double alpha = 0;                             ///< false-alarm rate of this gate over all its looks
  int looks = 0;                                ///< how often the samples were judged
  std::uint64_t samples = 0;                    ///< a pixel, in all
  double seconds = 0;                           ///< wall time of the engine's processes
  std::vector<FailingTile> tiles;               ///< worst first
  std::string image;                            ///< EXR of the engine's mean, relative to results.json; may be empty
  std::map<std::string, std::string> pictures;  ///< as Result::pictures
  std::vector<std::string> skipped;             ///< as Result::skipped
  std::string command;                          ///< how to repeat it
  friend bool operator==(const GateRecord&, const GateRecord&) = default;
};

/// This run against an older one: one quantity of one engine on one scene.
enum class Change { regression, improvement, unchanged, inconclusive };
std::string to_string(Change change);

struct ChangeRecord {
  std::string scene, engine;
  Budget budget;
  std::string quantity;             ///< "seconds" or "relmse"
  Estimate ratio;                   ///< new / old
  std::optional<Interval> control;  ///< the same ratio of an engine with itself (A/A)
  Change change = Change::inconclusive;
  std::string sentence;
  friend bool operator==(const ChangeRecord&, const ChangeRecord&) = default;
};

struct Results {
  std::string suite;    ///< its name
  std::string title{};  ///< its title: a report's heading; empty in records that do not say
  std::string created;  ///< UTC, ISO 8601
  std::string command;  ///< how the whole run is repeated
  Host host;
  std::map<std::string, std::string> versions;  ///< of libraries: "embree": "3.13.5", ...
  std::vector<SceneRecord> scenes;
  std::vector<EngineRecord> engines;
  std::vector<Result> results;  ///< references included
  // What the harness concluded from them; reports compute no statistics of their own.
  std::vector<Convergence> convergence;
  std::vector<RaceRecord> races;
  std::vector<GateRecord> gates;
  std::vector<ChangeRecord> changes;
  std::vector<std::string> findings;  ///< what only several results or gates show together
  std::vector<std::string> caveats;   ///< of the session: "the control's interval excludes 1: this machine is noisy"

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

}  // namespace photonproof::inline reports_record
