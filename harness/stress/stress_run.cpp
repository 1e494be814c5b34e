#include "harness/stress/stress_run.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numeric>

#include "harness/cells/cells.h"
#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/cells/side_by_side.h"
#include "harness/stress/level_run.h"
#include "harness/stress/looks.h"
#include "harness/stress/sweep.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/timer.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

/// Increase it whenever judging changes, so that levels are judged anew.
constexpr const char* judging_version = "9";
/// The most camera samples of a look. The second value is for a quick sweep that only finds the lowest level of a
/// failure at its end.
constexpr double samples_of_looks = 2e7, samples_of_short_looks = 1e6;

/// One sweep and one engine.
struct SweepRun {
  const Sweep* sweep;
  std::string engine;
};

bool is_unbiased(const std::string& engine) { return engine != "photonmapper" && engine != "sppm"; }

/// The picture to show, with a substitute for values that are not numbers.
Image shown(const Image& image, double factor) {
  Image out = image;
  for (std::size_t i = 0; i < out.rgb.size(); ++i) {
    out.rgb[i] = static_cast<float>(double{out.rgb[i]} / factor);
    if (!std::isfinite(out.rgb[i])) out.rgb[i] = i % 3 == 1 ? 0.0f : 1.0f;
  }
  return out;
}

class SweepRunner {
 public:
  SweepRunner(const StressOptions& options, StressRunner& runner) : options_(options), runner_(runner) {}

  StressSweep sweep_run(const SweepRun& sweep_run) {
    const Sweep& sweep = *sweep_run.sweep;
    StressSweep out;
    out.feature = sweep.feature;
    out.sweep_run = sweep.sweep_run;
    out.measure = sweep.measure;
    out.wanted = sweep.wanted;
    out.engine = sweep_run.engine;
    try {
      std::optional<StressLevel> last;
      if (options_.quick && !sweep.goes_on) {
        last = level(sweep_run, quick_height(sweep), samples_of_looks);
        if (last->outcome == LevelOutcome::right) {
          out.levels.push_back(*last);
          return out;
        }
      }
      for (const double height : sweep.heights) {  // it breaks at a lower level
        if (last && height > last->height) break;
        if (last && height == last->height)
          out.levels.push_back(*last);
        else
          out.levels.push_back(level(sweep_run, height, options_.quick ? samples_of_short_looks : samples_of_looks));
        const LevelOutcome outcome = out.levels.back().outcome;
        if (is_failure(outcome) || (outcome == LevelOutcome::refused && !sweep.goes_on)) break;
      }
    } catch (const InputError& error) {
      if (runner_.other(sweep_run.engine) == nullptr && !options_.is_other_program) throw;
      out.not_swept = error.summary();
      out.levels.clear();
    }
    return out;
  }

 private:
  static double quick_height(const Sweep& sweep) {
    double height = sweep.heights.front();
    for (const double h : sweep.heights)
      if (h <= (std::isnan(sweep.quick) ? sweep.wanted : sweep.quick)) height = h;
    return height;
  }

  /// The expectation, from this many samples a pixel.
  LevelExpectation expectation(const SweepRun& sweep_run, double height, int samples) {
    const Sweep& sweep = *sweep_run.sweep;
    LevelExpectation expected;
    expected.factor = sweep.factor(height);
    expected.radiance = sweep.radiance;
    expected.is_exact = is_unbiased(sweep_run.engine) && runner_.other(sweep_run.engine) == nullptr;
    expected.must_refuse = sweep.must_refuse;
    if (!sweep.alike) return expected;
    const std::string engine = sweep.compared_with.empty() ? sweep_run.engine : sweep.compared_with;
    expected.samples = samples;
    expected.picture = runner_.reference(sweep.alike(height), {engine, samples, 1});
    return expected;
  }

  StressScene scene(const SweepRun& sweep_run, double height) const {
    StressScene scene = sweep_run.sweep->level(height);
    if (runner_.other(sweep_run.engine) != nullptr && !(scene.arguments.empty() && scene.unlike_path.empty()))
      throw InputError(sweep_run.engine, "takes none of our programs' arguments");
    scene.arguments.insert(scene.arguments.end(), scene.unlike_path.begin(), scene.unlike_path.end());
    return scene;
  }

  StressLevel measured_level(const Sweep& sweep, double height) {
    const std::string key = content_key({{"judging", judging_version},
                                         {"program", runner_.checksum()},
                                         {"ladder", sweep.name()},
                                         {"height", format_number(height)}});
    const fs::path kept = options_.folder / "rungs" / (key + ".json");
    if (fs::exists(kept))
      if (const auto known = level_from_text(read_file(kept))) return *known;
    const Timer timer;
    const LevelVerdict verdict = sweep.measured(height, runner_);
    StressLevel out;
    out.height = height;
    out.outcome = verdict.outcome;
    out.sentence = verdict.sentence;
    out.would_see = verdict.would_see;
    out.seconds = timer.seconds();
    write_file_atomically(kept, level_text(out));
    return out;
  }

  StressLevel level(const SweepRun& sweep_run, double height, double most_samples) {
    if (sweep_run.sweep->measured) return measured_level(*sweep_run.sweep, height);
    const StressScene asked = scene(sweep_run, height);
    const std::string alike =
        sweep_run.sweep->alike ? runner_.key(sweep_run.sweep->alike(height), {sweep_run.engine, LevelLook().samples, 1})
                               : "";
    const std::string key = content_key({{"judging", judging_version},
                                         {"rung", runner_.key(asked, {sweep_run.engine, LevelLook().samples, 2})},
                                         {"alike", alike},
                                         {"most_samples", format_number(most_samples)}});
    const fs::path kept = options_.folder / "rungs" / (key + ".json");
    if (fs::exists(kept))
      if (auto known = level_from_text(read_file(kept))) {
        known->height = height;  // the level may be another sweep's with the same scene
        return *known;
      }
    const Timer timer;
    StressLevel out;
    try {
      out = decided(sweep_run, asked, height, most_samples, key);
    } catch (const ReferenceCrashed& crash) {
      out.height = height;
      out.outcome = LevelOutcome::crashed;
      out.sentence = "the reference to compare with " + crash.ending;
    }
    out.seconds = timer.seconds();
    write_file_atomically(kept, level_text(out));
    return out;
  }

  StressLevel decided(const SweepRun& sweep_run, const StressScene& asked, double height, double most_samples,
                      const std::string& key) {
    StressLevel out;
    out.height = height;
    LevelEvidence evidence;
    LevelExpectation expected;
    const double pixels = static_cast<double>(asked.width) * asked.height;
    for (std::optional<LevelLook> look = LevelLook(); look;) {
      if (look->expected_from != expected.samples) expected = expectation(sweep_run, height, look->expected_from);
      evidence = runner_.render(asked, {sweep_run.engine, look->samples, static_cast<std::uint64_t>(1 + look->number)});
      const LevelVerdict verdict = judge_level(evidence, expected);
      out.outcome = verdict.outcome;
      out.sentence = verdict.sentence;
      out.would_see = verdict.would_see;
      if (!evidence.picture) break;
      look = next_look(verdict, *look, most_samples / pixels);
    }
    if (out.outcome != LevelOutcome::right && evidence.picture) keep_pictures(*evidence.picture, expected, key, out);
    return out;
  }

  void keep_pictures(const Rendering& picture, const LevelExpectation& expected, const std::string& key,
                     StressLevel& out) {
    out.picture = "pictures/" + key + ".png";
    write_png((options_.folder / out.picture).string(), shown(picture.mean, expected.factor));
    if (!expected.picture && !expected.radiance) return;
    Image right(picture.mean.width, picture.mean.height);
    if (expected.picture)
      right = expected.picture->mean;
    else
      std::fill(right.rgb.begin(), right.rgb.end(), static_cast<float>(*expected.radiance));
    out.expected = "pictures/" + key + "-expected.png";
    write_png((options_.folder / out.expected).string(), right);
  }

  const StressOptions& options_;
  StressRunner& runner_;
};

std::vector<SweepRun> chosen(const StressOptions& options, const std::vector<Sweep>& sweeps) {
  std::vector<SweepRun> sweep_runs;
  for (const Sweep& sweep : sweeps) {
    const auto is_in_name = [&](const std::string& part) { return sweep.name().find(part) != std::string::npos; };
    if (!options.only.empty() && std::none_of(options.only.begin(), options.only.end(), is_in_name)) continue;
    const std::vector<std::string>& own = sweep.engines.empty() ? stress_engines() : sweep.engines;
    const auto sweeps_by_itself = [&](const std::string& engine) {
      return std::find(own.begin(), own.end(), engine) != own.end();
    };
    if (options.engines.empty())
      for (const std::string& engine : own)
        if (!options.quick || engine == own.front() || engine == "photonmapper") sweep_runs.push_back({&sweep, engine});
    for (const std::string& engine : options.engines) {
      // An engine that no sweep names runs all sweeps of path.
      const bool is_other = engine != "compare" && std::find(stress_engines().begin(), stress_engines().end(),
                                                             engine) == stress_engines().end();
      if (sweeps_by_itself(engine) || (is_other && sweeps_by_itself("path"))) sweep_runs.push_back({&sweep, engine});
    }
  }
  if (sweep_runs.empty())
    throw InputError("--only", "no sweep of that engine has '" + (options.only.empty() ? "" : options.only.front()) +
                                   "' in its name");
  return sweep_runs;
}

/// The order in which sweeps are started. Neighbours, which are compared with the same picture, are far apart: if they
/// started together, all except one would wait for that picture. Successive sweeps are a golden section of all apart,
/// which also keeps multiples of that step far apart.
std::vector<std::size_t> order_of(const std::vector<SweepRun>& sweep_runs) {
  constexpr double golden = 0.618;
  const std::size_t count = sweep_runs.size();
  std::size_t later = std::max<std::size_t>(1, static_cast<std::size_t>(golden * static_cast<double>(count)));
  while (std::gcd(later, count) != 1) --later;
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i * later % count] = i;
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return sweep_runs[i].sweep->takes_long; });
  return order;
}

std::vector<Sweep> sweeps_of(const StressOptions& options) {
  std::vector<Sweep> sweeps = stress_sweeps(options.folder / "assets");
  if (!options.turned) return sweeps;
  std::erase_if(sweeps, [](const Sweep& sweep) { return sweep.measured != nullptr || sweep.is_turned; });
  for (Sweep& sweep : sweeps) sweep = turned(std::move(sweep));
  return sweeps;
}

void make_folders(const fs::path& folder) {
  for (const char* part : {"assets", "rungs", "pictures"}) fs::create_directories(folder / part);
}

/// Moves a record of another program aside, never overwriting it.
void keep_earlier_record(const fs::path& file, const std::string& checksum) {
  if (!fs::exists(file)) return;
  std::string earlier = "unreadable";
  try {
    const std::string told = read_stress_record(file).checksum;  // becomes part of a file's name
    if (!told.empty() && std::ranges::all_of(told, [](unsigned char c) { return std::isxdigit(c) != 0; }))
      earlier = told;
  } catch (const InputError&) {
  }
  if (earlier != checksum) fs::rename(file, file.parent_path() / ("stress-" + earlier + ".json"));
}

}  // namespace

std::vector<std::string> stress_sweep_names(const fs::path& scratch) {
  std::vector<std::string> names;
  for (const Sweep& sweep : stress_sweeps(scratch)) names.push_back(sweep.name());
  return names;
}

StressRecord run_stress(const StressOptions& options) {
  const FolderLock lock(options.folder);
  make_folders(options.folder);
  const std::vector<Sweep> sweeps = sweeps_of(options);
  const std::vector<SweepRun> sweep_runs = chosen(options, sweeps);
  StressRunner runner(options.program, options.folder, options.others, options.interrupt);
  SweepRunner sweep_runner(options, runner);
  StressRecord record;
  record.created = utc_now();
  record.program = options.version;
  record.checksum = runner.checksum();
  record.command = options.command;
  record.quick = options.quick;
  const Host host = describe_host();
  record.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
  const Timer timer;
  std::vector<StressSweep> swept(sweep_runs.size());
  std::vector<char> done(sweep_runs.size(), 0);
  std::mutex telling;
  std::size_t ended = 0;
  const int jobs = options.jobs > 0 ? options.jobs : host.cores;
  const std::vector<std::size_t> order = order_of(sweep_runs);
  try {
    side_by_side(sweep_runs.size(), jobs, [&](std::size_t turn) {
      const std::size_t i = order[turn];
      swept[i] = sweep_runner.sweep_run(sweep_runs[i]);
      done[i] = 1;
      const std::lock_guard told(telling);
      ++ended;
      if (options.ended) options.ended(ended, sweep_runs.size(), swept[i]);
    });
  } catch (const StressInterrupted&) {
    record.interrupted = true;
  }
  for (std::size_t i = 0; i < sweep_runs.size(); ++i)
    if (done[i] != 0) record.sweeps.push_back(std::move(swept[i]));
  record.seconds = timer.seconds();
  const fs::path file = options.folder / "stress.json";
  keep_earlier_record(file, record.checksum);
  write_stress_record(record, file);
  return record;
}

}  // namespace photonproof::inline harness_stress
