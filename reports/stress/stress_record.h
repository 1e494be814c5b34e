// The record of `photonproof stress`: where each feature breaks in each engine, and whether that is said.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reports_stress {

enum class RungOutcome {
  right,           ///< the picture is what it has to be
  degraded,        ///< it is not, and the program says so
  refused,         ///< a clear error instead of a picture
  undecided,       ///< noise would hide an error
  silently_wrong,  ///< neither right nor said
  crashed          ///< no picture and no clear error, or no end
};
std::string to_string(RungOutcome outcome);
/// The only two that fail.
inline bool is_failure(RungOutcome outcome) {
  return outcome == RungOutcome::silently_wrong || outcome == RungOutcome::crashed;
}

struct StressRung {
  double height = 0;  ///< what it is: StressLadder::measure
  RungOutcome outcome = RungOutcome::undecided;
  std::string sentence;             ///< how it is wrong, what the program said, or what was found equal
  std::optional<double> would_see;  ///< the relative error of the mean that would have been seen, probability 0.99
  double seconds = 0;               ///< of its renders, by the wall clock
  std::string picture, expected;    ///< PNGs relative to the record, of a rung that is no picture as it should be
};

/// One ladder climbed by one engine, up to the first rung that fails or is refused.
struct StressLadder {
  std::string feature, climb, engine;
  std::string measure;            ///< "a unit of length of 10^k"
  double wanted = 0;              ///< the height that should be right
  std::string not_climbed;        ///< why the engine does not render the feature; empty otherwise
  std::vector<StressRung> rungs;  ///< ascending

  /// The first rung that fails; null where none does.
  const StressRung* breakdown() const;
  /// The last height up to which every rung is right.
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
  std::vector<StressLadder> ladders;

  std::size_t count(RungOutcome outcome) const;
  bool fails() const { return count(RungOutcome::silently_wrong) + count(RungOutcome::crashed) > 0; }
};

/// Throws InputError, naming the file, where it is no such record.
StressRecord read_stress_record(const std::filesystem::path& file);
void write_stress_record(const StressRecord& record, const std::filesystem::path& file);
/// One rung alone, as it is kept while the ladder is climbed.
std::string rung_text(const StressRung& rung);
/// Empty where the text is none.
std::optional<StressRung> rung_from_text(const std::string& text);

/// A sentence a rung that did better in `old`: right before degraded before refused before wrong. What is right counts
/// as right at all lesser heights, too, since quick climbs go there at once; what ended a climb counts beyond it.
/// Ladders and other heights that either lacks are not compared.
std::vector<std::string> steps_back(const StressRecord& old, const StressRecord& now);

}  // namespace photonproof::inline reports_stress
