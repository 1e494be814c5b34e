// The speed-up over the baseline and its points, from rounds in which both run one after the other. A round's ratio is
// of times next to each other. Their order turns every round, so that both share a slow drift of the machine. The
// interval of the mean logarithm is Student's t. A look is taken at 3, 5, 8, 12, 18 ... rounds and at the last one. The
// intervals of all looks together hold the ratio with probability 99 % (Bonferroni). So a ratio near a tier's beginning
// is not decided by the one look that excludes it by chance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "reports/grades/grade_record.h"

namespace photonproof::inline harness_grading {

/// One submission in one round, by timed scene.
struct SpeedRound {
  std::vector<double> baseline_seconds, seconds;  ///< The time of one run; the geometric mean of several.
  double busy = 0;                                ///< Cores that other programs used meanwhile.
};

inline constexpr std::size_t least_speed_rounds = 3;
/// The largest share of the cores that others may use in a round that counts.
inline constexpr double tolerated_busy_share = 0.1;
/// The relative width of an interval below which more rounds do not help.
inline constexpr double narrow_width = 0.02;

/// Whether a decision may be taken after this many rounds.
bool is_speed_look(std::size_t rounds);

struct SpeedJudgement {
  SpeedGrade grade;
  bool decided = false;  ///< False: another round may change the result.
};

/// Leaves out rounds in which others used the machine, while three others remain. A speed-up is decided when its
/// interval lies in one tier and is as narrow as the rule's precision, if any. `last`: no further round follows, so an
/// undecided one is "too noisy", with the reason. A tier that the interval reaches then counts if the interval is at
/// most 50 % wide; else the interval's lower end does.
SpeedJudgement judge_speed(const PerformanceRule& rule, const std::vector<std::string>& scenes,
                           const std::vector<SpeedRound>& rounds, int cores, bool last);

/// The points for a speed-up.
double points_for(const PerformanceRule& rule, double speedup);

/// "20 points from 2x, 40 from 5x" or "60 points at 20x, by the logarithm"
std::string rule_text(const PerformanceRule& rule);

}  // namespace photonproof::inline harness_grading
