#include "harness/grading/class_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/cells/cells.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

// The number of images of a scene that are timed in turn. Their seeds are the first correctness runs', so they are
// known.
constexpr std::size_t timed_seeds = 2;

nlohmann::json round_json(const std::vector<std::optional<SpeedRound>>& round, const std::vector<std::string>& names) {
  nlohmann::json json = nlohmann::json::object();
  for (std::size_t i = 0; i < round.size(); ++i)
    if (round[i])
      json[names[i]] = {
          {"baseline_seconds", round[i]->baseline_seconds}, {"seconds", round[i]->seconds}, {"busy", round[i]->busy}};
  return json;
}

std::vector<std::optional<SpeedRound>> round_of_json(const nlohmann::json& json,
                                                     const std::vector<std::string>& names) {
  std::vector<std::optional<SpeedRound>> round(names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto found = json.find(names[i]); found != json.end())
      round[i] = SpeedRound{found->at("baseline_seconds"), found->at("seconds"), found->at("busy")};
  return round;
}

class Timing {
 public:
  Timing(const ClassTiming& timing, const std::vector<PreparedSubmission>& prepared, std::vector<SubmissionWork>& works)
      : timing_(timing), prepared_(prepared), works_(works) {
    for (std::size_t s = 0; s < timing.scenes.size(); ++s)
      if (timing.references[s] && timing.assignment.is_timed(timing.scenes[s].row.name)) timed_.push_back(s);
    for (std::size_t i = 0; i < works.size(); ++i)
      if (is_to_be_timed(works[i])) timed_works_.push_back(i);
  }

  void all() {
    if (timed_.empty()) return;
    if (!timed_works_.empty()) time();
    for (SubmissionWork& work : works_)
      if (work.grade.speed.state == SpeedGrade::State::none && work.grade.built) work.grade.speed = speed_of_same(work);
    watch_untimed_scenes();
  }

 private:
  void time() {
    SpeedSession session = session_on(timed_, timed_works_);
    session.rule = *timing_.assignment.performance;
    session.keep = [this](const auto& round) { keep(round); };
    find_kept(session);
    const std::vector<SpeedGrade> grades = time_submissions(session);
    for (std::size_t i = 0; i < grades.size(); ++i) works_[timed_works_[i]].grade.speed = grades[i];
  }

  // Runs of these submissions on these scenes; both outlive the session.
  SpeedSession session_on(const std::vector<std::size_t>& scenes, const std::vector<std::size_t>& works) {
    SpeedSession session;
    for (const std::size_t s : scenes) session.scenes.push_back(timing_.scenes[s].row.name);
    session.submissions = works.size();
    session.cores = timing_.cores;
    session.progress = timing_.progress;
    session.run = [&](std::optional<std::size_t> submission, std::size_t scene, std::size_t number) {
      return run(submission ? std::optional(works[*submission]) : std::nullopt, scenes[scene], number);
    };
    return session;
  }

  // Times scenes that earn no points for speed, above all hidden ones: a program that is fast only on the timed scenes
  // recognises them. Submissions that the correctness runs do not clear are timed in three rounds.
  void watch_untimed_scenes() {
    for (std::size_t s = 0; s < timing_.scenes.size(); ++s) {
      if (!timing_.references[s] || std::ranges::find(timed_, s) != timed_.end()) continue;
      std::vector<std::size_t> watched;
      for (const std::size_t i : timed_works_)
        if (may_be_slow(works_[i], s)) watched.push_back(i);
      if (watched.empty() || timing_.runs.is_interrupted()) continue;
      const std::vector<std::size_t> scene{s};
      SpeedSession session = session_on(scene, watched);
      session.rule.rounds = least_speed_rounds;
      session.rule.seconds = timing_.assignment.performance->seconds;
      session.keep = [](const auto&) {};
      const std::vector<SpeedGrade> grades = time_submissions(session);
      for (std::size_t i = 0; i < grades.size(); ++i) flag_slow(works_[watched[i]], s, grades[i]);
    }
  }

  // True if the first correctness runs, which ran beside others, show less than three quarters of its speed-up there,
  // by the logarithm.
  bool may_be_slow(const SubmissionWork& work, std::size_t s) const {
    const std::optional<Interval>& speedup = work.grade.speed.speedup.interval;
    const auto& mine = work.scenes[s];
    const auto& baseline = timing_.baseline_work.scenes[s];
    if (!speedup || speedup->low <= 1 || !mine || !mine->grade.counts_as_right() || !baseline) return false;
    const double ratio =
        baseline->grade.runs.front().wall_seconds / std::max(mine->grade.runs.front().wall_seconds, 1e-6);
    return std::log(ratio) < 0.75 * std::log(work.grade.speed.speedup.value);
  }

  // Flags a submission that surely lacks half of its speed-up, by the logarithm. Copies of the program are as slow.
  void flag_slow(const SubmissionWork& timed, std::size_t s, const SpeedGrade& there) {
    const Estimate& speedup = timed.grade.speed.speedup;
    const std::optional<Interval>& interval = there.speedup.interval;
    if (!interval || interval->high >= std::sqrt(speedup.interval->low)) return;
    const WorkScene& scene = timing_.scenes[s];
    const std::string sentence = fmt::format(
        "{}scene {}: {:.3g} times as fast as the baseline ({:.3g} to {:.3g}), but {:.3g} times on the timed {}",
        scene.row.hidden ? "hidden " : "", scene.row.name, there.speedup.value, interval->low, interval->high,
        speedup.value, timed_.size() == 1 ? "scene" : "scenes");
    const std::string checksum = timed.grade.checksum;
    for (SubmissionWork& work : works_) {
      if (work.grade.checksum != checksum) continue;
      work.grade.flags.push_back({"fast-on-timed-only", sentence, scene.row.name, {}});
      work.grade.speed.sentence += "; " + sentence;
    }
  }

  bool is_to_be_timed(SubmissionWork& work) const {
    SpeedGrade& speed = work.grade.speed;
    for (std::size_t s = 0; s < timing_.scenes.size(); ++s) {
      const bool is_needed = timing_.assignment.performance->needs_all || std::ranges::find(timed_, s) != timed_.end();
      if (!is_needed || !timing_.references[s]) continue;
      if (!work.scenes[s] || !work.scenes[s]->grade.counts_as_right()) {
        speed.state = SpeedGrade::State::not_right;
        speed.sentence = "not timed: " + std::string(timing_.scenes[s].row.hidden ? "hidden " : "") + "scene " +
                         timing_.scenes[s].row.name + " is not right";
        return false;
      }
    }
    return work.grade.built && !is_baseline(work) && std::ranges::none_of(timed_works_, [&](std::size_t other) {
             return works_[other].grade.checksum == work.grade.checksum;
           });
  }

  bool is_baseline(const SubmissionWork& work) const { return work.grade.checksum == timing_.baseline.checksum; }

  // The speed of a submission that equals a timed one or the baseline: timing it again would only show noise.
  SpeedGrade speed_of_same(const SubmissionWork& work) const {
    for (const std::size_t other : timed_works_)
      if (works_[other].grade.checksum == work.grade.checksum) return works_[other].grade.speed;
    SpeedGrade speed;
    speed.state = SpeedGrade::State::measured;
    speed.speedup = {1, Interval{1, 1}};
    speed.sentence = "is the baseline, unchanged: 1 times as fast, without being timed";
    speed.points = points_for(*timing_.assignment.performance, 1);
    return speed;
  }

  // `submission` and `s` count all submissions and scenes.
  TimedRun run(std::optional<std::size_t> submission, std::size_t s, std::size_t number) {
    const PreparedSubmission& program = submission ? prepared_[*submission] : timing_.baseline;
    const auto cell = timing_.runs.run_timed(program, timing_.scenes[s], number % timed_seeds);
    TimedRun timed;
    if (!cell) {
      timed.interrupted = true;
      return timed;
    }
    timed.seconds = cell->run.wall_seconds;
    if (!cell->image)
      timed.problem = "failed: " + cell->run.sentence;
    else if (submission)
      timed.problem = image_problem_of(works_[*submission], s, number % timed_seeds, *cell->image);
    return timed;
  }

  // An image equal to an earlier one needs no second verdict.
  std::string image_problem_of(const SubmissionWork& work, std::size_t s, std::size_t number,
                               const Image& image) const {
    const std::vector<Image>& before = work.scenes[s]->images;
    if (number < before.size() && before[number].rgb == image.rgb) return {};
    const Image* const only = &image;
    const SceneJudgement judgement =
        judge_scene(timing_.assignment.correctness, *timing_.references[s], {&only, 1}, true);
    if (judgement.verdict != SceneVerdict::wrong || !judgement.decided) return {};
    return "gave another image: " + judgement.sentence;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const std::size_t i : timed_works_) all.push_back(prepared_[i].checksum + " " + prepared_[i].name);
    return all;
  }

  fs::path round_file(int number) const {
    std::vector<std::string> parts{timing_.assignment.text, timing_.baseline.checksum, std::to_string(timing_.cores)};
    for (const std::string& name : names()) parts.push_back(name);
    return timing_.folder / "rounds" /
           (content_key({{"rounds", length_prefixed(parts)}}) + "-" + std::to_string(number) + ".json");
  }

  void keep(const std::vector<std::optional<SpeedRound>>& round) {
    fs::create_directories(timing_.folder / "rounds");
    write_file_atomically(round_file(++kept_), json_text(round_json(round, names())));
  }

  // Keeps only whole rounds: a ratio of times from two sessions would mean nothing.
  void find_kept(SpeedSession& session) {
    while (fs::exists(round_file(kept_ + 1))) {
      ++kept_;
      if (!timing_.resume) {
        fs::remove(round_file(kept_));
        continue;
      }
      try {
        session.kept.push_back(round_of_json(nlohmann::json::parse(read_file(round_file(kept_))), names()));
      } catch (const nlohmann::json::exception&) {
        fs::remove(round_file(kept_--));
        break;
      }
    }
    if (!timing_.resume) kept_ = 0;
  }

  const ClassTiming& timing_;
  const std::vector<PreparedSubmission>& prepared_;
  std::vector<SubmissionWork>& works_;
  std::vector<std::size_t> timed_;        // scenes
  std::vector<std::size_t> timed_works_;  // submissions
  int kept_ = 0;
};

}  // namespace

void time_class(const ClassTiming& timing, const std::vector<PreparedSubmission>& prepared,
                std::vector<SubmissionWork>& works) {
  Timing(timing, prepared, works).all();
}

}  // namespace photonproof::inline harness_grading
