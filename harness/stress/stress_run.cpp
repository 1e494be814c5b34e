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
#include "harness/stress/ladder.h"
#include "harness/stress/looks.h"
#include "harness/stress/rung_run.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/timer.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

/// Changes when judging does, so that rungs are judged anew.
constexpr const char* judging_version = "9";
/// Camera samples of a look at most, and where a quick climb only tells at which rung what is not right at its end
/// begins.
constexpr double samples_of_looks = 2e7, samples_of_short_looks = 1e6;

/// One ladder and one engine.
struct Climb {
  const Ladder* ladder;
  std::string engine;
};

bool is_unbiased(const std::string& engine) { return engine != "photonmapper" && engine != "sppm"; }

/// What a picture shows where it is no number.
Image shown(const Image& image, double factor) {
  Image out = image;
  for (std::size_t i = 0; i < out.rgb.size(); ++i) {
    out.rgb[i] = static_cast<float>(double{out.rgb[i]} / factor);
    if (!std::isfinite(out.rgb[i])) out.rgb[i] = i % 3 == 1 ? 0.0f : 1.0f;
  }
  return out;
}

class Climber {
 public:
  Climber(const StressOptions& options, StressRunner& runner) : options_(options), runner_(runner) {}

  StressLadder climb(const Climb& climb) {
    const Ladder& ladder = *climb.ladder;
    StressLadder out;
    out.feature = ladder.feature;
    out.climb = ladder.climb;
    out.measure = ladder.measure;
    out.wanted = ladder.wanted;
    out.engine = climb.engine;
    try {
      std::optional<StressRung> last;
      if (options_.quick && !ladder.climbs_on) {
        last = rung(climb, quick_height(ladder), samples_of_looks);
        if (last->outcome == RungOutcome::right) {
          out.rungs.push_back(*last);
          return out;
        }
      }
      for (const double height : ladder.heights) {  // where it breaks is further down
        if (last && height > last->height) break;
        if (last && height == last->height)
          out.rungs.push_back(*last);
        else
          out.rungs.push_back(rung(climb, height, options_.quick ? samples_of_short_looks : samples_of_looks));
        const RungOutcome outcome = out.rungs.back().outcome;
        if (is_failure(outcome) || (outcome == RungOutcome::refused && !ladder.climbs_on)) break;
      }
    } catch (const InputError& error) {
      if (runner_.other(climb.engine) == nullptr && !options_.is_other_program) throw;
      out.not_climbed = error.summary();
      out.rungs.clear();
    }
    return out;
  }

 private:
  static double quick_height(const Ladder& ladder) {
    double height = ladder.heights.front();
    for (const double h : ladder.heights)
      if (h <= (std::isnan(ladder.quick) ? ladder.wanted : ladder.quick)) height = h;
    return height;
  }

  /// From so many samples a pixel.
  RungExpectation expectation(const Climb& climb, double height, int samples) {
    const Ladder& ladder = *climb.ladder;
    RungExpectation expected;
    expected.factor = ladder.factor(height);
    expected.radiance = ladder.radiance;
    expected.is_exact = is_unbiased(climb.engine) && runner_.other(climb.engine) == nullptr;
    expected.must_refuse = ladder.must_refuse;
    if (!ladder.alike) return expected;
    const std::string engine = ladder.compared_with.empty() ? climb.engine : ladder.compared_with;
    expected.samples = samples;
    expected.picture = runner_.reference(ladder.alike(height), {engine, samples, 1});
    return expected;
  }

  StressScene scene(const Climb& climb, double height) const {
    StressScene scene = climb.ladder->rung(height);
    if (runner_.other(climb.engine) != nullptr && !(scene.arguments.empty() && scene.unlike_path.empty()))
      throw InputError(climb.engine, "takes none of our programs' arguments");
    scene.arguments.insert(scene.arguments.end(), scene.unlike_path.begin(), scene.unlike_path.end());
    return scene;
  }

  StressRung measured_rung(const Ladder& ladder, double height) {
    const std::string key = content_key({{"judging", judging_version},
                                         {"program", runner_.checksum()},
                                         {"ladder", ladder.name()},
                                         {"height", format_number(height)}});
    const fs::path kept = options_.folder / "rungs" / (key + ".json");
    if (fs::exists(kept))
      if (const auto known = rung_from_text(read_file(kept))) return *known;
    const Timer timer;
    const RungVerdict verdict = ladder.measured(height, runner_);
    StressRung out;
    out.height = height;
    out.outcome = verdict.outcome;
    out.sentence = verdict.sentence;
    out.would_see = verdict.would_see;
    out.seconds = timer.seconds();
    write_file_atomically(kept, rung_text(out));
    return out;
  }

  StressRung rung(const Climb& climb, double height, double most_samples) {
    if (climb.ladder->measured) return measured_rung(*climb.ladder, height);
    const StressScene asked = scene(climb, height);
    const std::string alike =
        climb.ladder->alike ? runner_.identity(climb.ladder->alike(height), {climb.engine, RungLook().samples, 1}) : "";
    const std::string key = content_key({{"judging", judging_version},
                                         {"rung", runner_.identity(asked, {climb.engine, RungLook().samples, 2})},
                                         {"alike", alike},
                                         {"most_samples", format_number(most_samples)}});
    const fs::path kept = options_.folder / "rungs" / (key + ".json");
    if (fs::exists(kept))
      if (auto known = rung_from_text(read_file(kept))) {
        known->height = height;  // it may be another ladder's, whose rung is the same
        return *known;
      }
    const Timer timer;
    StressRung out;
    try {
      out = decided(climb, asked, height, most_samples, key);
    } catch (const ReferenceCrashed& crash) {
      out.height = height;
      out.outcome = RungOutcome::crashed;
      out.sentence = "what it is compared with " + crash.ending;
    }
    out.seconds = timer.seconds();
    write_file_atomically(kept, rung_text(out));
    return out;
  }

  StressRung decided(const Climb& climb, const StressScene& asked, double height, double most_samples,
                     const std::string& key) {
    StressRung out;
    out.height = height;
    RungEvidence evidence;
    RungExpectation expected;
    const double pixels = static_cast<double>(asked.width) * asked.height;
    for (std::optional<RungLook> look = RungLook(); look;) {
      if (look->expected_from != expected.samples) expected = expectation(climb, height, look->expected_from);
      evidence = runner_.render(asked, {climb.engine, look->samples, static_cast<std::uint64_t>(1 + look->number)});
      const RungVerdict verdict = judge_rung(evidence, expected);
      out.outcome = verdict.outcome;
      out.sentence = verdict.sentence;
      out.would_see = verdict.would_see;
      if (!evidence.picture) break;
      look = next_look(verdict, *look, most_samples / pixels);
    }
    if (out.outcome != RungOutcome::right && evidence.picture) keep_pictures(*evidence.picture, expected, key, out);
    return out;
  }

  void keep_pictures(const Rendering& picture, const RungExpectation& expected, const std::string& key,
                     StressRung& out) {
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

std::vector<Climb> chosen(const StressOptions& options, const std::vector<Ladder>& ladders) {
  std::vector<Climb> climbs;
  for (const Ladder& ladder : ladders) {
    const auto is_in_name = [&](const std::string& part) { return ladder.name().find(part) != std::string::npos; };
    if (!options.only.empty() && std::none_of(options.only.begin(), options.only.end(), is_in_name)) continue;
    const std::vector<std::string>& own = ladder.engines.empty() ? stress_engines() : ladder.engines;
    const auto climbs_by_itself = [&](const std::string& engine) {
      return std::find(own.begin(), own.end(), engine) != own.end();
    };
    if (options.engines.empty())
      for (const std::string& engine : own)
        if (!options.quick || engine == own.front() || engine == "photonmapper") climbs.push_back({&ladder, engine});
    for (const std::string& engine : options.engines) {
      // One that no ladder names by itself climbs all that path does.
      const bool is_other = engine != "compare" && std::find(stress_engines().begin(), stress_engines().end(),
                                                             engine) == stress_engines().end();
      if (climbs_by_itself(engine) || (is_other && climbs_by_itself("path"))) climbs.push_back({&ladder, engine});
    }
  }
  if (climbs.empty())
    throw InputError("--only", "no ladder of that engine has '" + (options.only.empty() ? "" : options.only.front()) +
                                   "' in its name");
  return climbs;
}

/// The order in which climbs are begun: neighbours, which are compared with the same picture, far apart, since of those
/// that need it at the same time all but one would wait. Each is a golden section of all later than the one before, by
/// which multiples of it are far apart, too.
std::vector<std::size_t> order_of(const std::vector<Climb>& climbs) {
  constexpr double golden = 0.618;
  const std::size_t count = climbs.size();
  std::size_t later = std::max<std::size_t>(1, static_cast<std::size_t>(golden * static_cast<double>(count)));
  while (std::gcd(later, count) != 1) --later;
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i * later % count] = i;
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return climbs[i].ladder->takes_long; });
  return order;
}

std::vector<Ladder> ladders_of(const StressOptions& options) {
  std::vector<Ladder> ladders = stress_ladders(options.folder / "assets");
  if (!options.turned) return ladders;
  std::erase_if(ladders, [](const Ladder& ladder) { return ladder.measured != nullptr || ladder.is_turned; });
  for (Ladder& ladder : ladders) ladder = turned(std::move(ladder));
  return ladders;
}

void make_folders(const fs::path& folder) {
  for (const char* part : {"assets", "rungs", "references", "pictures"}) fs::create_directories(folder / part);
}

/// A record of another program is moved aside, never written over.
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

std::vector<std::string> stress_ladder_names(const fs::path& scratch) {
  std::vector<std::string> names;
  for (const Ladder& ladder : stress_ladders(scratch)) names.push_back(ladder.name());
  return names;
}

StressRecord run_stress(const StressOptions& options) {
  const FolderLock lock(options.folder);
  make_folders(options.folder);
  const std::vector<Ladder> ladders = ladders_of(options);
  const std::vector<Climb> climbs = chosen(options, ladders);
  StressRunner runner(options.program, options.folder, options.others, options.interrupt);
  Climber climber(options, runner);
  StressRecord record;
  record.created = utc_now();
  record.program = options.version;
  record.checksum = runner.checksum();
  record.command = options.command;
  record.quick = options.quick;
  const Host host = describe_host();
  record.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
  const Timer timer;
  std::vector<StressLadder> climbed(climbs.size());
  std::vector<char> done(climbs.size(), 0);
  std::mutex telling;
  std::size_t ended = 0;
  const int jobs = options.jobs > 0 ? options.jobs : host.cores;
  const std::vector<std::size_t> order = order_of(climbs);
  try {
    side_by_side(climbs.size(), jobs, [&](std::size_t turn) {
      const std::size_t i = order[turn];
      climbed[i] = climber.climb(climbs[i]);
      done[i] = 1;
      const std::lock_guard told(telling);
      ++ended;
      if (options.ended) options.ended(ended, climbs.size(), climbed[i]);
    });
  } catch (const StressInterrupted&) {
    record.interrupted = true;
  }
  for (std::size_t i = 0; i < climbs.size(); ++i)
    if (done[i] != 0) record.ladders.push_back(std::move(climbed[i]));
  record.seconds = timer.seconds();
  const fs::path file = options.folder / "stress.json";
  keep_earlier_record(file, record.checksum);
  write_stress_record(record, file);
  return record;
}

}  // namespace photonproof::inline harness_stress
