// The record of `photonproof stress`: the level at which each feature breaks in each engine, and whether the engine
// reports it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reports_stress {

enum class LevelOutcome {
  right,           ///< the picture is as expected
  degraded,        ///< it is not, and the program reports it
  refused,         ///< a clear error message instead of a picture
  undecided,       ///< noise could hide an error
  silently_wrong,  ///< neither right nor reported
  crashed          ///< no picture and no clear error message, or no end
};
std::string to_string(LevelOutcome outcome);
/// The only two outcomes that fail.
inline bool is_failure(LevelOutcome outcome) {
  return outcome == LevelOutcome::silently_wrong || outcome == LevelOutcome::crashed;
}

struct StressLevel {
  double height = 0;  ///< value of StressSweep::measure
  LevelOutcome outcome = LevelOutcome::undecided;
  std::string sentence;             ///< the error, the program's message, or the comparison's result
  std::optional<double> would_see;  ///< minimum detectable relative error of the mean, with probability 0.99
  double seconds = 0;               ///< of its renders, by the wall clock
  std::string picture, expected;    ///< PNGs relative to the record, if the picture is not as expected
};

/// One sweep climbed by one engine, up to the first level that fails or is refused.
struct StressSweep {
  std::string feature, sweep_run, engine;
  std::string measure;              ///< "a unit of length of 10^k"
  double wanted = 0;                ///< the height that should be right
  std::string not_swept;            ///< why the engine does not render the feature; empty otherwise
  std::vector<StressLevel> levels;  ///< ascending

  /// The first level that fails; null if none does.
  const StressLevel* breakdown() const;
  /// The last height up to which every level is right.
  std::optional<double> right_up_to() const;
  bool reaches_wanted() const;
};

struct StressRecord {
  std::string created;   ///< UTC, ISO 8601
  std::string program;   ///< its version
  std::string checksum;  ///< of the program's file
  std::string host, command;
  bool quick = false, interrupted = false;
  double seconds = 0;
  std::vector<StressSweep> sweeps;

  std::size_t count(LevelOutcome outcome) const;
  bool fails() const { return count(LevelOutcome::silently_wrong) + count(LevelOutcome::crashed) > 0; }
};

/// Throws InputError, naming the file, if it is no such record.
StressRecord read_stress_record(const std::filesystem::path& file);
void write_stress_record(const StressRecord& record, const std::filesystem::path& file);
/// One level alone, as stored during the climb.
std::string level_text(const StressLevel& level);
/// Empty if the text is no level.
std::optional<StressLevel> level_from_text(const std::string& text);

/// One sentence per level that was better in `old`, in the order right, degraded, refused, wrong. A right level counts
/// as right at all lesser heights, since quick climbs start there. The end of a climb counts for all greater heights.
/// Sweeps and other heights that only one record has are not compared.
std::vector<std::string> steps_back(const StressRecord& old, const StressRecord& now);

}  // namespace photonproof::inline reports_stress
