// The record of a benchmark run: one Result per cell, with the suite, host and versions of the run. results.json stores
// it; the schema beside it (results.schema.json) is its contract. Reports and gates are views of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/images/exposure_range.h"

namespace photonproof::inline reports_record {

inline constexpr int results_schema_version = 1;

/// How a cell ended. Unless it is `ok`, metrics are empty and `detail` gives the reason in one sentence.
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

/// First words of warnings that come from the engine itself.
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

/// Ends of a 95 % confidence interval, unless its owner states another level.
struct Interval {
  double low = 0, high = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A number with its uncertainty, if known.
struct Estimate {
  double value = 0;
  std::optional<Interval> interval;
  friend bool operator==(const Estimate&, const Estimate&) = default;
};

/// Time of the harness's own calibration workload beside a cell (harness/cells/calibration.h).
struct CalibrationReading {
  std::string workload;  ///< the workload and its compiler; readings of two workloads are not comparable
  int threads = 1;       ///< that did the work at the same time
  double seconds = 0;    ///< processor time of one thread, the mean of the readings before and after the cell
  friend bool operator==(const CalibrationReading&, const CalibrationReading&) = default;
};

struct Result {
  Cell cell;
  std::string
      key;  ///< content hash of everything that decides the outcome (scene, engine, version, budget, seed, limits)
  Status status = Status::ok;
  std::string detail;                         ///< the reason unless ok, in one sentence
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
  std::vector<std::string> skipped;      ///< passes that the engine skipped, with the reason
  std::string engine_version;
  std::string command;               ///< repeats the cell, as typed
  std::vector<std::string> caveats;  ///< e.g. "host was busy (load 3.1)", or declared_by_engine and one of its losses
};

/// A stored reference that a scene was compared with, and its origin.
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
  /// Why errors against the reference are unreliable: "the reference is by photonmapper, which is biased". Empty if
  /// they are reliable.
  std::string reference_doubt{};
  std::string title{};  ///< from expect.toml, for pages; empty: the name stands there
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

/// Correctness of images. `right`: they agree with the reference, and a small error would be detected. `noisy`: they
/// agree, but a large error could hide. `biased`: they differ by more than noise. `unknown`: no statement is possible.
enum class Correctness { right, noisy, biased, unknown };
std::string to_string(Correctness correctness);

/// The verdict on a budget's images, by the gates' statistics (harness/bench/correctness.h).
struct CorrectnessRecord {
  Correctness verdict = Correctness::unknown;
  std::string sentence;  ///< place and size of the error, or why there is no verdict
  std::optional<Estimate>
      whole;  ///< relative error of the whole image in its worst channel; its interval is the test's
  /// Minimum detectable relative error, with probability 0.99, of the whole image and of a block of 8 x 8 pixels; only
  /// if right.
  std::optional<double> would_see, would_see_in_a_block;
  /// If biased: the largest relative error of a block of 8 x 8 pixels, with the interval of all blocks together.
  std::optional<Estimate> block{};
  std::string regression_only{};  ///< as in GateRecord
  friend bool operator==(const CorrectnessRecord&, const CorrectnessRecord&) = default;
};

/// Reasons for missing numbers, by their names in results.json: {"slope": "two budgets"}.
using Reasons = std::map<std::string, std::string>;

/// The time axis of a curve: wall time of the engine's process, or processor time of all its threads.
enum class Clock { wall, processor };
std::string to_string(Clock clock);
std::optional<Clock> clock_from_string(const std::string& name);
/// Seconds of a cell, if measured.
std::optional<double> seconds_by(Clock clock, const Result& result);

/// One budget of an engine on a scene, over its seeds.
struct ConvergencePoint {
  Budget budget;
  int seeds = 0;                   ///< finished cells
  Estimate seconds;                ///< median, by the curve's clock
  std::optional<Estimate> relmse;  ///< mean; absent without a reference
  /// Interval of relmse by the spread over seeds. Set where relmse has none, since rare bright samples may be missing.
  std::optional<Interval> spread_of_seeds{};
  std::optional<Estimate> bias2;     ///< relative as relmse is; present if its interval excludes 0
  std::optional<Estimate> variance;  ///< relative, of one image; needs two seeds
  std::optional<CorrectnessRecord> correctness{};
  Reasons undefined{};
  friend bool operator==(const ConvergencePoint&, const ConvergencePoint&) = default;
};

/// The time at which an engine's error falls to a target of the suite.
struct TargetTime {
  double relmse = 0;
  std::optional<Estimate> seconds{};  ///< interpolated between measured budgets, never beyond them
  /// Bounds if there is no value: `more_than` is the largest budget's seconds, with an error still above the target.
  /// `at_most` is the smallest budget's, with an error already below it.
  std::optional<double> more_than{}, at_most{};
  std::string undefined{};  ///< why nothing is known of the time; else empty
  friend bool operator==(const TargetTime&, const TargetTime&) = default;
};

/// Error against time of one engine on one scene, by harness/conclusions/convergence.h.
struct Convergence {
  std::string scene, engine;
  Clock clock = Clock::wall;
  std::vector<ConvergencePoint> points;  ///< of one kind of budget, ascending
  std::optional<Estimate> slope;         ///< least squares of log relmse on log seconds
  std::optional<Estimate> efficiency;    ///< 1/(relmse seconds) at the largest budget
  std::vector<TargetTime> targets{};     ///< the suite's targets for the scene
  std::vector<std::string> caveats;
  Reasons undefined{};
  friend bool operator==(const Convergence&, const Convergence&) = default;
};

/// The engines of a scene against each other: the time that each takes to one error, and the error of each at one time.
/// Ratios are those to the engine ranked first. Intervals combine those of both engines.
struct RaceRecord {
  struct Time {
    std::string engine;
    double seconds = 0;                  ///< Interpolated between its budgets, or a bound.
    bool at_most = false;                ///< Its smallest budget is below that error already, so it may need less.
    bool more_than = false;              ///< Its largest budget is still above that error, so it needs more.
    bool unranked = false;               ///< A bound that leaves the order open.
    std::optional<Interval> interval{};  ///< Interval of a value, by error_curve.h.
    std::optional<Estimate> ratio{};     ///< Ratio to the first engine's seconds. The first and the unranked have none.
    bool at_least = false;               ///< The ratio is a bound, which holds with the interval's confidence.
    friend bool operator==(const Time&, const Time&) = default;
  };
  struct Error {
    std::string engine;
    Estimate relmse;                  ///< Interpolated between its budgets.
    std::optional<Estimate> ratio{};  ///< Ratio to the least error, which has none.
    friend bool operator==(const Error&, const Error&) = default;
  };
  std::string scene;
  double relmse = 0;
  bool is_target = false;     ///< The suite asks for this error.
  std::vector<Time> times;    ///< Fastest first, then engines without a rank. Empty if `undecided`.
  double seconds = 0;         ///< The time of `errors`.
  std::vector<Error> errors;  ///< Least first. Empty where fewer than two engines have budgets around one time.
  std::string undecided{};    ///< The reason why no engine is known to be faster.
  friend bool operator==(const RaceRecord&, const RaceRecord&) = default;
};

enum class GateVerdict { pass, fail, inconclusive };
std::string to_string(GateVerdict verdict);

/// A part of an image where a gate failed, in pixels, row 0 on top.
struct FailingTile {
  int x = 0, y = 0, width = 0, height = 0;
  /// Rank of the tile: standard errors beyond noise, or for gates on a metric of `compare` the tile's share of the
  /// error.
  double score = 0;
  std::string sentence;  ///< "+6 % at the floor's contact, 41 px"
  friend bool operator==(const FailingTile&, const FailingTile&) = default;
};

/// Decision of one gate.
struct GateRecord {
  std::string name;  ///< unique within a run
  std::string scene, engine, metric;
  GateVerdict verdict = GateVerdict::inconclusive;
  std::string sentence;  ///< place and kind of the decision
  /// How the engine ended without an image for the gate. The verdict is then about that, not about images.
  std::optional<Status> status{};
  std::optional<Estimate> observed;
  std::optional<double> bound;
  /// For an agreement gate that passes: minimum detectable relative error of the whole image, and of a block of 8 x 8
  /// pixels, with probability 0.99.
  std::optional<double> would_see, would_see_in_a_block;
  /// Why the gate can only detect changes: the engine's own estimator made the reference. Empty: it can prove an error.
  std::string regression_only;
  /// Time of the verdict (UTC, ISO 8601) if another run made it; its images are that run's.
  std::string accepted{};
  double alpha = 0;                             ///< false-alarm rate of this gate over all its looks
  int looks = 0;                                ///< number of tests of the samples
  std::uint64_t samples = 0;                    ///< per pixel, in all
  double seconds = 0;                           ///< wall time of the engine's processes
  std::vector<FailingTile> tiles;               ///< worst first
  std::string image;                            ///< EXR of the engine's mean, relative to results.json; may be empty
  std::map<std::string, std::string> pictures;  ///< as Result::pictures
  std::vector<std::string> skipped;             ///< as Result::skipped
  std::string command;                          ///< repeats the gate
  friend bool operator==(const GateRecord&, const GateRecord&) = default;
};

/// Change against an older run: one quantity of one engine on one scene.
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
  std::string title{};  ///< its title, the report's heading; empty in older records
  std::string created;  ///< UTC, ISO 8601
  std::string command;  ///< repeats the whole run
  Host host;
  std::map<std::string, std::string> versions;  ///< of libraries: "embree": "3.13.5", ...
  std::vector<SceneRecord> scenes;
  std::vector<EngineRecord> engines;
  std::vector<Result> results;  ///< references included
  // The harness's conclusions; reports compute no statistics of their own.
  std::vector<Convergence> convergence;
  std::vector<RaceRecord> races;
  std::vector<GateRecord> gates;
  std::vector<ChangeRecord> changes;
  std::vector<std::string> findings;  ///< findings that need several results or gates
  std::vector<std::string> caveats;   ///< of the session: "the control's interval excludes 1: this machine is noisy"

  const Result* find(const std::string& cell_label) const;
};

/// Validates against the schema first. Throws InputError with file and JSON pointer, also if two results are of the
/// same cell.
Results read_results(const std::string& path);
/// Atomic: writes a file beside it and renames that. Validates the record; a number that is not finite is a
/// std::logic_error.
void write_results(const std::string& path, const Results& results);

/// One result alone, as stored in a cell's folder; its paths are relative to the run's results.json.
struct KeptResult {
  Result result;
  std::string comparison_key;  ///< content hash of what the metrics and pictures were made with; empty before they are
};
/// The same checks as for a whole run.
KeptResult read_result(const std::string& path);
void write_result(const std::string& path, const KeptResult& kept);

}  // namespace photonproof::inline reports_record
