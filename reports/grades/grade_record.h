// The record of `photonproof grade` about a class. The gradebook, Gradescope's files and the pages are views of it, and
// grades.json stores it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline reports_grades {

inline constexpr int grades_version = 1;

/// A scene of the grading, with the reference of its images.
struct GradedScene {
  std::string name;
  bool hidden = false, timed = false;
  double max_points = 0;
  int width = 0, height = 0;
  std::string of, variant;        ///< of a variant: its scene and its kind
  std::string says;               ///< the variant's change, in words
  std::string reference;          ///< where it comes from: "mean of 8 runs of the baseline"
  std::string reference_image;    ///< EXR, relative to grades.json
  std::string reference_picture;  ///< PNG
  std::string unused;             ///< why the scene does not count; empty: it counts
};

/// One run of a submission and its result.
struct GradedRun {
  std::uint64_t seed = 0;
  std::string end;       ///< "ok", "crash", "timeout", "memory" ...
  std::string sentence;  ///< the reason, unless ok
  double wall_seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::string image;     ///< EXR, relative to grades.json; empty when there is none
  std::string checksum;  ///< of the image's values
  std::string log_tail;  ///< end of its output
};

/// One bound on one metric.
struct GradedCheck {
  std::string metric;  ///< of `compare`, or "blocks"
  Estimate value;      ///< mean over the runs; the verdict was decided by its interval
  double bound = 0;
  std::string parameters;
  enum class Side { inside, outside, undecided } side = Side::inside;
  std::string sentence;
};
std::string to_string(GradedCheck::Side side);

/// A mistake in the image (harness/diagnosis).
struct GradedFinding {
  std::string kind, sentence, cause;
  int x = 0, y = 0, width = 0, height = 0;  ///< where, in pixels
  double explained = 0;                     ///< share of the squared error
};

/// `borderline`: noise leaves it open, which counts as right. `wrong`: a wrong image. `failed`: no image. `unused`: the
/// scene does not count. `skipped`: not graded in this run.
enum class SceneVerdict { right, borderline, wrong, failed, unused, skipped };
std::string to_string(SceneVerdict verdict);

struct SceneGrade {
  std::string scene;
  SceneVerdict verdict = SceneVerdict::skipped;
  std::string sentence;
  std::vector<GradedCheck> checks;
  std::vector<GradedFinding> findings;
  std::vector<GradedRun> runs;
  std::map<std::string, std::string> pictures;  ///< PNGs relative to grades.json: "image", "flip"
  double partial = 0;                           ///< share of the points that a wrong image keeps, in [0, 1]
  double points = 0;
  bool counts_as_right() const { return verdict == SceneVerdict::right || verdict == SceneVerdict::borderline; }
};

/// One timed scene.
struct SceneSpeed {
  std::string scene;
  Estimate ratio;                                 ///< speed-up: the baseline's time over its own
  std::vector<double> baseline_seconds, seconds;  ///< by round: of the baseline, and the mean of its own runs
  std::vector<double> busy;                       ///< by round: cores that others used meanwhile
};

struct SpeedGrade {
  enum class State { none, not_right, measured, too_noisy, changed } state = State::none;
  Estimate speedup;  ///< geometric mean of the scenes' ratios; the interval has 99 %
  std::vector<SceneSpeed> scenes;
  int rounds = 0;
  std::string sentence;
  double points = 0;
};
std::string to_string(SpeedGrade::State state);

/// A warning for staff. It costs no points by itself unless the sentence says so.
struct GradeFlag {
  std::string kind;  ///< "copy-of-reference", "same-as-other", "seed-ignored", "parameters-ignored", "runs-differ",
                     ///< "right-on-public-only", "fast-on-timed-only" ...
  std::string sentence;
  std::string scene, other;  ///< the place; the other submission or scene
};

struct SubmissionGrade {
  std::string name, folder;  ///< folder: relative to grades.json
  std::string source, checksum;
  bool built = false;
  std::string build_sentence, build_log;
  double build_seconds = 0;
  std::vector<SceneGrade> scenes;
  SpeedGrade speed;
  std::vector<GradeFlag> flags;
  double correctness_points = 0;
  std::string sentence;  ///< the most important result
  double points() const { return correctness_points + speed.points; }
  const SceneGrade* scene(const std::string& scene_name) const;
};

/// Points for a speed-up of at least `ratio`.
struct SpeedTier {
  double ratio = 0, points = 0;
};

struct Grades {
  std::string assignment, title, created, command;
  Host host;
  std::map<std::string, std::string> versions;
  std::uint64_t seed = 1;
  bool contained = true;    ///< in the sandbox
  std::string containment;  ///< the method, or the reason why not
  double correctness_points = 0, speed_points = 0;
  std::string speed_rule;                ///< "20 points from 2x, 40 from 5x"
  std::vector<SpeedTier> speed_tiers;    ///< ascending; empty if there is a curve
  std::optional<SpeedTier> speed_curve;  ///< no points at 1, its points at its ratio, in between by the logarithm
  std::vector<GradedScene> scenes;
  std::vector<SubmissionGrade> submissions;
  std::vector<std::string> caveats;
  bool interrupted = false;
  double max_points() const { return correctness_points + speed_points; }
};

/// The flag that shows that images are not the program's own renders; null if none does. It tells of a copy, a kept
/// result, parameters that change nothing, or another scene's image where only hidden scenes are wrong. Such a
/// submission has no place; its points stay.
const GradeFlag* caught_at(const SubmissionGrade& submission);

/// Best first: points, then speed-up, then name. Submissions that were caught come last. Pointers into `grades`.
std::vector<const SubmissionGrade*> leaderboard(const Grades& grades);

}  // namespace photonproof::inline reports_grades
