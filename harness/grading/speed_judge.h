// How much faster than the baseline, and what that earns: from rounds in which both ran, one after the other. A round's
// ratio is that of times next to each other, in an order that turns every round, so that a machine that slowly changes
// is shared. The interval of the mean logarithm is Student's t. Rounds are looked at when there are 3, 5, 8, 12, 18 ...
// and when there will be no more; 99 % is the chance that the intervals of all these looks hold the ratio, so that
// whoever is near a tier's beginning is not decided by the look that happens to exclude it (Bonferroni).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "reports/grades/grade_record.h"

namespace photonproof::inline harness_grading {

/// One submission in one round, by timed scene.
struct SpeedRound {
  std::vector<double> baseline_seconds, seconds;  ///< of one run; where several were made, their geometric mean
  double busy = 0;                                ///< cores that others used meanwhile
};

inline constexpr std::size_t least_speed_rounds = 3;
/// Others may use this share of the cores before a round is not counted.
inline constexpr double tolerated_busy_share = 0.1;
/// More rounds would not help where the interval is as narrow as this, relatively.
inline constexpr double narrow_width = 0.02;

/// Whether a decision may be taken with so many rounds.
bool is_speed_look(std::size_t rounds);

struct SpeedJudgement {
  SpeedGrade grade;
  bool decided = false;  ///< false: another round may change it
};

/// Rounds in which others used the machine are left out while three are left without. Decided is what lies in one tier,
/// by an interval as narrow as the rule's precision, if it has one. `last`: there will be no further round, so that
/// what is not decided is "too noisy", and says why. Then a tier that the interval reaches counts if the interval is at
/// most 50 % wide; else the interval's lower end does.
SpeedJudgement judge_speed(const PerformanceRule& rule, const std::vector<std::string>& scenes,
                           const std::vector<SpeedRound>& rounds, int cores, bool last);

/// Points for a speed-up.
double points_for(const PerformanceRule& rule, double speedup);

/// "20 points from 2x, 40 from 5x" or "60 points at 20x, by the logarithm"
std::string rule_text(const PerformanceRule& rule);

}  // namespace photonproof::inline harness_grading
