#include "harness/stress/faults/faults_run.h"

#include <algorithm>
#include <map>
#include <utility>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/stress/faults/fault_rows.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/splitmix.h"
#include "scenes/base/timer.h"
#include "scenes/files/checksum.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_sentences = 5;

struct Pair {
  const FaultRow* row;
  const Work* work;
  int asked;  // requested trials, or kills
};

std::string name_of(const FaultRow& row, const Work& work) { return row.name + ", " + work.name; }

std::vector<Pair> chosen_pairs(const FaultsOptions& options) {
  std::vector<Pair> pairs;
  for (const FaultRow& row : fault_rows())
    for (const Work& work : works())
      if (name_of(row, work).find(options.only) != std::string::npos)
        pairs.push_back({&row, &work, options.quick ? row.quick : row.full});
  if (pairs.empty())
    throw InputError("--only", "no fault has '" + options.only + "' in its name; --list has the names");
  const auto is_kill = [](const Pair& pair) { return pair.row->is_kill; };
  int sharing = static_cast<int>(std::count_if(pairs.begin(), pairs.end(), is_kill)), left = options.kills;
  for (Pair& pair : pairs) {
    if (!pair.row->is_kill) continue;
    pair.asked = (left + sharing - 1) / sharing;
    left -= pair.asked;
    --sharing;
  }
  return pairs;
}

class Faults {
 public:
  explicit Faults(const FaultsOptions& options) : options_(options), file_(options.folder / "faults.json") {
    const std::string checksum = file_checksum(options.program);
    if (fs::exists(file_)) record_ = read_faults_record(file_);
    // A record of another program or seed does not count.
    if (record_.checksum != checksum || record_.seed != options.seed) record_ = {};
    record_.created = utc_now();
    record_.program = options.version;
    record_.checksum = checksum;
    record_.command = options.command;
    record_.seed = options.seed;
    record_.interrupted = false;
    const Host host = describe_host();
    record_.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
    place_ = {fs::absolute(options.program), fs::absolute(options.folder) / "inputs",
              fs::absolute(options.folder) / "out"};
    trial_folder_ = options.folder / "trial";
  }

  FaultsRecord run() {
    const std::vector<Pair> pairs = chosen_pairs(options_);
    const double before = record_.seconds;
    const Timer timer;
    prepare_works(place_.program, place_.inputs);
    fs::create_directories(trial_folder_);
    for (const Pair& pair : pairs) all_ += pair.asked;
    for (const Pair& pair : pairs) {
      try_pair(pair);
      record_.seconds = before + timer.seconds();
      write_faults_record(record_, file_);
      if (record_.interrupted) break;
    }
    if (!record_.interrupted && !record_.fails()) fs::remove_all(place_.out);
    return record_;
  }

 private:
  void try_pair(const Pair& pair) {
    FaultOutcome& outcome = record_.of(pair.row->name, pair.work->name);
    outcome.asked = pair.asked;
    outcome.not_tried.clear();
    while ((pair.row->is_kill ? outcome.count : outcome.trials) < pair.asked) {
      if (options_.interrupt != nullptr && *options_.interrupt) {
        record_.interrupted = true;
        return;
      }
      try {
        try_once(pair, outcome);
      } catch (const NotTried& reason) {
        outcome.not_tried = reason.why;
        return;
      }
    }
    done_ += pair.asked;
  }

  void try_once(const Pair& pair, FaultOutcome& outcome) {
    const Trial trial{*pair.work, place_, trial_folder_, in_peace(*pair.work), seed_of(pair, outcome.trials)};
    begin_anew(place_);
    TrialResult result = pair.row->run(trial);
    ++outcome.trials;
    outcome.count += result.count;
    if (!result.broken.empty()) {
      ++outcome.broken_count;
      const std::string sentence = "trial " + std::to_string(outcome.trials) + ": " + result.broken;
      if (outcome.broken.size() < most_sentences) outcome.broken.push_back(sentence);
    }
    write_faults_record(record_, file_);
    if (options_.progress)
      options_.progress(done_ + (pair.row->is_kill ? outcome.count : outcome.trials), all_, outcome);
  }

  const Undisturbed& in_peace(const Work& work) {
    const auto known = undisturbed_.find(work.name);
    if (known != undisturbed_.end()) return known->second;
    return undisturbed_.emplace(work.name, undisturbed(work, place_, trial_folder_)).first->second;
  }

  std::uint64_t seed_of(const Pair& pair, int trial) const {
    Checksum sum;
    const std::string name = name_of(*pair.row, *pair.work);
    sum.add(name.data(), name.size());
    return splitmix64(options_.seed ^ sum.value(), static_cast<std::uint64_t>(trial));
  }

  const FaultsOptions& options_;
  fs::path file_, trial_folder_;
  WorkPlace place_;
  FaultsRecord record_;
  std::map<std::string, Undisturbed> undisturbed_;
  int done_ = 0, all_ = 0;
};

}  // namespace

std::vector<std::string> fault_names() {
  std::vector<std::string> names;
  for (const FaultRow& row : fault_rows())
    for (const Work& work : works()) names.push_back(name_of(row, work));
  return names;
}

FaultsRecord run_faults(const FaultsOptions& options) {
  const FolderLock lock(options.folder);
  return Faults(options).run();
}

}  // namespace photonproof::inline harness_stress_faults
