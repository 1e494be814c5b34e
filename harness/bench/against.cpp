#include "harness/bench/against.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <map>
#include <random>
#include <variant>

#include "harness/cells/host.h"
#include "harness/conclusions/stored_changes.h"
#include "harness/statistics/relative_error.h"
#include "harness/suites/engine_command.h"
#include "scenes/base/input_error.h"
#include "scenes/base/percent_text.h"
#include "scenes/base/timer.h"
#include "scenes/files/file_checksum.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_bench {
namespace {

namespace fs = std::filesystem;

constexpr double longest_warm_up = 20;

// The numbers of a round, or the reason why there are none ("" when it was interrupted).
using Round = std::variant<PairedRound, std::string>;

std::string difference_text(double ratio) { return percent_text(std::abs(ratio - 1)); }

std::string seconds_sentence(const RatioVerdict& verdict, std::size_t rounds) {
  const std::string facts = fmt::format("processor time new/old {}, {} rounds", ratio_text(verdict.ratio), rounds);
  switch (verdict.change) {
    case Change::regression:
      return difference_text(verdict.ratio.value) + " slower: " + facts;
    case Change::improvement:
      return difference_text(verdict.ratio.value) + " faster: " + facts;
    case Change::unchanged:
      return "as fast as before: " + facts;
    case Change::inconclusive:
      break;
  }
  return "cannot tell whether it is slower, " + verdict.reason + ": " + facts;
}

std::string relmse_sentence(const RatioVerdict& verdict, std::span<const PairedRound> rounds) {
  if (std::all_of(rounds.begin(), rounds.end(), [](const PairedRound& round) { return round.same_image; }))
    return fmt::format("same images, to the bit, for {} seed{}", rounds.size(), rounds.size() == 1 ? "" : "s");
  const std::string facts = fmt::format("relmse new/old {}, {} seeds", ratio_text(verdict.ratio), rounds.size());
  switch (verdict.change) {
    case Change::regression:
      return difference_text(verdict.ratio.value) + " more error: " + facts;
    case Change::improvement:
      return difference_text(verdict.ratio.value) + " less error: " + facts;
    case Change::unchanged:
      return "other images with the same error: " + facts;
    case Change::inconclusive:
      break;
  }
  return "cannot tell whether the error grew, " + verdict.reason + ": " + facts;
}

ChangeRecord record_of(const Cell& cell, const char* quantity, const RatioVerdict& verdict, std::string sentence) {
  ChangeRecord record;
  record.scene = cell.scene;
  record.engine = cell.engine;
  record.budget = cell.budget;
  record.quantity = quantity;
  record.ratio = verdict.ratio;
  record.control = verdict.control;
  record.change = verdict.change;
  record.sentence = std::move(sentence);
  return record;
}

// Runs the old program, the new one and the old one again on one cell, all at once on one processor.
class PairRunner {
 public:
  PairRunner(const AgainstRun& run, fs::path old_program)
      : run_(run), programs_{old_program, run.program, old_program}, processors_(allowed_processors()) {}

  // Starts both programs once, so that later starts do not read them from disk.
  void warm_up(const Engine& engine) const {
    ProcessOptions options;
    options.wall_limit_seconds = longest_warm_up;
    options.interrupt = run_.interrupt;
    for (const auto& command : engine.version_commands)
      for (const fs::path& program : {programs_[0], programs_[1]}) {
        CommandValues values;
        values.photonproof = program;
        values.suite = run_.suite.folder;
        usual_executor().run(fill_command(command, values), options);
      }
  }

  Round run(Cell cell, std::size_t number, const Image* reference) {
    cell.seed += number;
    std::array<std::size_t, 3> order{0, 1, 2};
    for (std::size_t i = 2; i > 0; --i) std::swap(order[i], order[generator_() % (i + 1)]);
    std::array<std::future<std::optional<Result>>, 3> runs;
    for (const std::size_t which : order)
      runs[which] =
          std::async(std::launch::async, [this, &cell, which, number] { return run_one(cell, which, number); });
    std::array<Result, 3> results;
    std::optional<std::string> problem;
    for (const std::size_t which : {0, 1, 2}) {
      std::optional<Result> result = runs[which].get();
      if (!result)
        problem = "";
      else if (result->status != Status::ok && !problem)
        problem = fmt::format("the {} program: {} ({})", which == 1 ? "new" : "old", to_string(result->status),
                              result->detail);
      if (result) results[which] = std::move(*result);
    }
    if (problem) return *problem;

    PairedRound round;
    round.old_seconds = *results[0].cpu_seconds;
    round.new_seconds = *results[1].cpu_seconds;
    round.again_seconds = *results[2].cpu_seconds;
    if (std::min({round.old_seconds, round.new_seconds, round.again_seconds}) <= 0)
      return std::string("the engine's processor time is too short to be measured");
    const Image old_image = read_stored(run_of(cell, 0).image().string()).mean,
                new_image = read_stored(run_of(cell, 1).image().string()).mean;
    round.same_image = old_image.rgb == new_image.rgb;
    if (reference != nullptr) {
      round.old_relmse = relative_mse(*reference, old_image);
      round.new_relmse = relative_mse(*reference, new_image);
    }
    return round;
  }

 private:
  EngineRun run_of(const Cell& cell, std::size_t which) const {
    constexpr std::array<const char*, 3> stems{"old", "new", "again"};
    EngineRun run = run_.run_of(cell, std::string(against_folder) + "/" + stems[which]);
    run.program = programs_[which];
    // Three programs share one processor.
    run.limits.seconds *= 3;
    return run;
  }

  std::optional<Result> run_one(const Cell& cell, std::size_t which, std::size_t number) const {
    EngineRun one = run_of(cell, which);
    fs::remove_all(one.place());
    fs::create_directories(one.place());
    if (!processors_.empty()) one.processor = processors_[number % processors_.size()];
    return run_engine(one);
  }

  const AgainstRun& run_;
  std::array<fs::path, 3> programs_;
  std::vector<int> processors_;
  std::mt19937_64 generator_{1};  // any seed: it only shuffles who starts first
};

class Comparisons {
 public:
  Comparisons(const AgainstRun& run, const Results& old_run, const AgainstOptions& options)
      : run_(run), options_(options), old_(old_run) {}

  std::vector<ChangeRecord> all() {
    for (const Cell& cell : compared_cells()) {
      if (is_interrupted()) break;
      if (!options_.old_program.empty() && is_ours(cell.engine))
        in_rounds(cell);
      else
        for (ChangeRecord& record : stored_changes(old_, run_.now, cell, options_.thresholds)) say(std::move(record));
    }
    std::error_code ignored;
    fs::remove_all(run_.folder / against_folder, ignored);
    return std::move(changes_);
  }

 private:
  bool is_interrupted() const { return run_.interrupt != nullptr && *run_.interrupt; }

  void say(ChangeRecord record) {
    if (run_.heard) run_.heard(record);
    changes_.push_back(std::move(record));
  }

  // The old version can replace only {photonproof}, no other program.
  bool is_ours(const std::string& engine) const { return run_.suite.engine(engine).command.front() == "{photonproof}"; }

  // For every scene and engine that the old run has too: the largest budget of each kind, with its least seed.
  std::vector<Cell> compared_cells() const {
    std::vector<Cell> cells;
    for (const Cell& cell : run_.suite.cells) {
      const bool known = std::any_of(old_.results.begin(), old_.results.end(), [&](const Result& old) {
        return old.cell.scene == cell.scene && old.cell.engine == cell.engine;
      });
      const bool is_control = !run_.suite.control.empty() && cell.engine == control_name(run_.suite.control);
      if (!known || is_control || cell.label().find(run_.only) == std::string::npos) continue;
      const auto same = std::find_if(cells.begin(), cells.end(), [&](const Cell& other) {
        return other.scene == cell.scene && other.engine == cell.engine && other.budget.kind == cell.budget.kind;
      });
      if (same == cells.end())
        cells.push_back(cell);
      else if (std::pair(cell.budget.amount, same->seed) > std::pair(same->budget.amount, cell.seed))
        *same = cell;
    }
    return cells;
  }

  // Null when the scene has no reference; read once.
  const Image* reference_of(const std::string& scene_name) {
    if (const auto found = references_.find(scene_name); found != references_.end())
      return found->second ? &*found->second : nullptr;
    std::optional<Image>& image = references_[scene_name];
    for (const SceneRecord& scene : run_.now.scenes) {
      if (scene.name != scene_name) continue;
      const Result* result = run_.now.find(scene.reference_label);
      const std::string file = scene.reference ? scene.reference->image : result != nullptr ? result->image : "";
      if (!file.empty()) image = read_stored((run_.folder / file).string()).mean;
    }
    return image ? &*image : nullptr;
  }

  void in_rounds(const Cell& cell) {
    PairRunner runner(run_, options_.old_program);
    runner.warm_up(run_.suite.engine(cell.engine));
    const bool times_count = cell.budget.kind != "seconds";
    const Timer timer;
    std::vector<PairedRound> rounds;
    RatioVerdict seconds;
    std::optional<RatioVerdict> relmse;
    const auto decided = [&] {
      const bool by_time = !times_count || seconds.change != Change::inconclusive;
      return by_time && (!relmse || relmse->change != Change::inconclusive);
    };
    do {
      const Round round = runner.run(cell, rounds.size(), reference_of(cell.scene));
      if (const auto* problem = std::get_if<std::string>(&round)) {
        if (!problem->empty()) say(record_of(cell, "seconds", {{1, {}}, {}, Change::inconclusive, {}}, *problem));
        return;
      }
      rounds.push_back(std::get<PairedRound>(round));
      seconds = judge_seconds(rounds, options_.thresholds);
      relmse = judge_relmse(rounds, options_.thresholds);
    } while (!decided() && rounds.size() < options_.most_rounds && !is_interrupted() &&
             timer.seconds() < options_.seconds);
    if (times_count) say(record_of(cell, "seconds", seconds, seconds_sentence(seconds, rounds.size())));
    if (relmse) say(record_of(cell, "relmse", *relmse, relmse_sentence(*relmse, rounds)));
  }

  const AgainstRun& run_;
  const AgainstOptions& options_;
  const Results& old_;
  std::map<std::string, std::optional<Image>> references_;
  std::vector<ChangeRecord> changes_;
};

}  // namespace

std::vector<ChangeRecord> changes_against(const AgainstRun& run, const Results& old_run,
                                          const AgainstOptions& options) {
  return Comparisons(run, old_run, options).all();
}

Results read_old_run(const AgainstOptions& options) {
  if (!options.old_program.empty() && !fs::is_regular_file(options.old_program))
    throw InputError("--old-program", "no such file: " + options.old_program.string());
  return read_results(options.results.string());
}

std::string program_hash(const fs::path& program) { return file_checksum(program); }

}  // namespace photonproof::inline harness_bench
