// The record of `photonproof stress`: where each feature breaks in each engine, and whether that is said.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reports_stress {

enum class LevelOutcome {
  right,           ///< the picture is what it has to be
  degraded,        ///< it is not, and the program says so
  refused,         ///< a clear error instead of a picture
  undecided,       ///< noise would hide an error
  silently_wrong,  ///< neither right nor said
  crashed          ///< no picture and no clear error, or no end
};
std::string to_string(LevelOutcome outcome);
/// The only two that fail.
inline bool is_failure(LevelOutcome outcome) {
  return outcome == LevelOutcome::silently_wrong || outcome == LevelOutcome::crashed;
}

struct StressLevel {
  double height = 0;  ///< what it is: StressSweep::measure
  LevelOutcome outcome = LevelOutcome::undecided;
  std::string sentence;             ///< how it is wrong, what the program said, or what was found equal
  std::optional<double> would_see;  ///< the relative error of the mean that would have been seen, probability 0.99
  double seconds = 0;               ///< of its renders, by the wall clock
  std::string picture, expected;    ///< PNGs relative to the record, of a level that is no picture as it should be
};

/// One sweep climbed by one engine, up to the first level that fails or is refused.
struct StressSweep {
  std::string feature, sweep_run, engine;
  std::string measure;              ///< "a unit of length of 10^k"
  double wanted = 0;                ///< the height that should be right
  std::string not_swept;            ///< why the engine does not render the feature; empty otherwise
  std::vector<StressLevel> levels;  ///< ascending

  /// The first level that fails; null where none does.
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

/// Throws InputError, naming the file, where it is no such record.
StressRecord read_stress_record(const std::filesystem::path& file);
void write_stress_record(const StressRecord& record, const std::filesystem::path& file);
/// One level alone, as it is kept while the sweep is climbed.
std::string level_text(const StressLevel& level);
/// Empty where the text is none.
std::optional<StressLevel> level_from_text(const std::string& text);

/// A sentence a level that did better in `old`: right before degraded before refused before wrong. What is right counts
/// as right at all lesser heights, too, since quick climbs go there at once; what ended a climb counts beyond it.
/// Sweeps and other heights that either lacks are not compared.
std::vector<std::string> steps_back(const StressRecord& old, const StressRecord& now);

}  // namespace photonproof::inline reports_stress
