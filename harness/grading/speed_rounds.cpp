#include "harness/grading/speed_rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/cells/others_busy.h"
#include "scenes/base/timer.h"

namespace photonproof::inline harness_grading {
namespace {

// A fast submission runs repeatedly for this share of the baseline's time, at most `most_repeats` times.
constexpr double share_of_baseline = 0.25;
constexpr double most_repeats = 5;

class Rounds {
 public:
  explicit Rounds(const SpeedSession& session)
      : session_(session), rounds_(session.submissions), problems_(session.submissions), decided_(session.submissions) {
    for (const auto& round : session.kept) take(round);
  }

  std::vector<SpeedGrade> all() {
    if (!is_over()) warm_up();
    while (!is_over() && !interrupted_) {
      session_.progress(fmt::format("timing: round {} of at most {}, {} submissions", number_ + 1, session_.rule.rounds,
                                    std::ranges::count(decided_, false)));
      one_round();
    }
    std::vector<SpeedGrade> grades;
    for (std::size_t i = 0; i < session_.submissions; ++i) grades.push_back(grade_of(i));
    return grades;
  }

 private:
  bool is_over() const {
    return std::ranges::all_of(decided_, [](bool decided) { return decided; }) || number_ >= session_.rule.rounds ||
           timer_.seconds() > session_.rule.seconds;
  }

  SpeedGrade grade_of(std::size_t i) const {
    if (problems_[i].empty())
      return judge_speed(session_.rule, session_.scenes, rounds_[i], session_.cores, true).grade;
    SpeedGrade grade;
    grade.state = SpeedGrade::State::changed;
    grade.sentence = "while it was timed it " + problems_[i];
    return grade;
  }

  void take(const std::vector<std::optional<SpeedRound>>& round) {
    ++number_;
    for (std::size_t i = 0; i < session_.submissions; ++i) {
      if (round[i]) rounds_[i].push_back(*round[i]);
      decided_[i] = !problems_[i].empty() ||
                    judge_speed(session_.rule, session_.scenes, rounds_[i], session_.cores, false).decided;
    }
  }

  TimedRun run(std::optional<std::size_t> submission, std::size_t scene) {
    TimedRun one = session_.run(submission, scene, runs_++);
    interrupted_ = interrupted_ || one.interrupted;
    if (submission && !one.problem.empty() && problems_[*submission].empty()) problems_[*submission] = one.problem;
    return one;
  }

  // The first runs read programs and files from disk. Their times give the number of repeats.
  void warm_up() {
    session_.progress("timing: warming up");
    baseline_seconds_.assign(session_.scenes.size(), 0);
    seconds_.assign(session_.submissions, std::vector<double>(session_.scenes.size(), 0));
    for (std::size_t s = 0; s < session_.scenes.size() && !interrupted_; ++s) {
      baseline_seconds_[s] = run(std::nullopt, s).seconds;
      for (std::size_t i = 0; i < session_.submissions && !interrupted_; ++i)
        if (!decided_[i]) seconds_[i][s] = run(i, s).seconds;
    }
  }

  int repeats(std::size_t i, std::size_t s) const {
    if (seconds_[i][s] <= 0) return 1;
    return static_cast<int>(std::clamp(share_of_baseline * baseline_seconds_[s] / seconds_[i][s], 1.0, most_repeats));
  }

  void run_submission(std::size_t i, std::size_t s, SpeedRound& round) {
    const int times = repeats(i, s);
    double logarithms = 0;
    for (int k = 0; k < times && !interrupted_; ++k) {
      const TimedRun one = run(i, s);
      logarithms += std::log(std::max(one.seconds, 1e-6)) / times;
    }
    round.seconds[s] = std::exp(logarithms);
  }

  void one_round() {
    const std::size_t scenes = session_.scenes.size();
    std::vector<std::optional<SpeedRound>> round(session_.submissions);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < session_.submissions; ++i)
      if (!decided_[i]) order.push_back(i);
    const bool baseline_first = number_ % 2 == 0;
    if (!baseline_first) std::ranges::reverse(order);
    for (const std::size_t i : order) round[i] = SpeedRound{{}, std::vector<double>(scenes), 0};
    std::vector<double> baseline(scenes);
    const OthersBusy busy;
    for (std::size_t s = 0; s < scenes; ++s) {
      if (baseline_first && !interrupted_) baseline[s] = run(std::nullopt, s).seconds;
      for (const std::size_t i : order)
        if (!interrupted_) run_submission(i, s, *round[i]);
      if (!baseline_first && !interrupted_) baseline[s] = run(std::nullopt, s).seconds;
    }
    if (interrupted_) return;
    const double others = busy.cores();
    for (const std::size_t i : order) {
      round[i]->baseline_seconds = baseline;
      round[i]->busy = others;
    }
    session_.keep(round);
    take(round);
  }

  const SpeedSession& session_;
  std::vector<std::vector<SpeedRound>> rounds_;  // by submission
  std::vector<std::string> problems_;            // by submission
  std::vector<bool> decided_;
  std::vector<double> baseline_seconds_;
  std::vector<std::vector<double>> seconds_;  // by submission and scene, of the warm-up
  int number_ = 0;
  std::size_t runs_ = 0;
  bool interrupted_ = false;
  Timer timer_;
};

}  // namespace

std::vector<SpeedGrade> time_submissions(const SpeedSession& session) { return Rounds(session).all(); }

}  // namespace photonproof::inline harness_grading
