#include "reports/stress/stress_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/record/file_inside.h"
#include "reports/stress/stress_fields.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline reports_stress {
namespace {

int rank(LevelOutcome outcome) {
  switch (outcome) {
    case LevelOutcome::right:
      return 3;
    case LevelOutcome::degraded:
      return 2;
    case LevelOutcome::refused:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

std::string to_string(LevelOutcome outcome) { return word_of(outcome); }

const StressLevel* StressSweep::breakdown() const {
  for (const StressLevel& level : levels)
    if (is_failure(level.outcome)) return &level;
  return nullptr;
}

std::optional<double> StressSweep::right_up_to() const {
  std::optional<double> height;
  for (const StressLevel& level : levels) {
    if (level.outcome != LevelOutcome::right) break;
    height = level.height;
  }
  return height;
}

bool StressSweep::reaches_wanted() const {
  return std::all_of(levels.begin(), levels.end(), [&](const StressLevel& level) {
    return level.height > wanted || level.outcome == LevelOutcome::right;
  });
}

std::size_t StressRecord::count(LevelOutcome outcome) const {
  std::size_t n = 0;
  for (const StressSweep& sweep : sweeps)
    for (const StressLevel& level : sweep.levels) n += level.outcome == outcome ? 1 : 0;
  return n;
}

std::string level_text(const StressLevel& level) { return json_text(record_json(level)) + "\n"; }

std::optional<StressLevel> level_from_text(const std::string& text) try {
  RecordSource source{"rung"};
  StressLevel level = read_record<StressLevel>(parse_record(text, source.file), source);
  refuse_files_outside(source.files);
  return level;
} catch (const InputError&) {
  return std::nullopt;
}

void write_stress_record(const StressRecord& record, const std::filesystem::path& file) {
  write_file_atomically(file, json_text(record_json(record)) + "\n");
}

StressRecord read_stress_record(const std::filesystem::path& file) {
  RecordSource source{file.string()};
  StressRecord record = read_record<StressRecord>(parse_record(read_file(file), source.file), source);
  refuse_files_outside(source.files, std::filesystem::absolute(file).parent_path());
  return record;
}

namespace {

/// Result at a height: its own level if there is one. Beyond the last level it is the end of the climb. Below a right
/// level it is right, since a quick climb begins there.
std::optional<StressLevel> level_at(const StressSweep& sweep, double height) {
  for (const StressLevel& level : sweep.levels)
    if (level.height == height) return level;
  if (sweep.levels.empty()) return std::nullopt;
  StressLevel last = sweep.levels.back();
  if (height > last.height && (is_failure(last.outcome) || last.outcome == LevelOutcome::refused)) return last;
  const std::optional<double> right = sweep.right_up_to();
  if (!right || height > *right) return std::nullopt;
  last.outcome = LevelOutcome::right;
  return last;
}

bool is_worse(const StressLevel& now, const StressLevel& before) {
  return before.outcome != LevelOutcome::undecided && now.outcome != LevelOutcome::undecided &&
         rank(now.outcome) < rank(before.outcome);
}

std::vector<std::string> steps_of_sweep(const StressSweep& old, const StressSweep& now) {
  std::set<double> heights;
  for (const StressSweep* sweep : {&old, &now})
    for (const StressLevel& level : sweep->levels) heights.insert(level.height);
  std::vector<std::string> sentences;
  std::optional<double> told;  // an ended climb is reported once
  for (const double height : heights) {
    const std::optional<StressLevel> before = level_at(old, height), level = level_at(now, height);
    if (!before || !level || !is_worse(*level, *before) || told == level->height) continue;
    told = level->height;
    sentences.push_back(fmt::format("{}, {}, {}, k = {:g}: {} before, now {}: {}", now.feature, now.sweep_run,
                                    now.engine, level->height, to_string(before->outcome), to_string(level->outcome),
                                    level->sentence));
  }
  return sentences;
}

}  // namespace

std::vector<std::string> steps_back(const StressRecord& old, const StressRecord& now) {
  std::vector<std::string> sentences;
  for (const StressSweep& sweep : now.sweeps) {
    const auto before = std::find_if(old.sweeps.begin(), old.sweeps.end(), [&](const StressSweep& other) {
      return other.feature == sweep.feature && other.sweep_run == sweep.sweep_run && other.engine == sweep.engine;
    });
    if (before == old.sweeps.end()) continue;
    const std::vector<std::string> own = steps_of_sweep(*before, sweep);
    sentences.insert(sentences.end(), own.begin(), own.end());
  }
  return sentences;
}

}  // namespace photonproof::inline reports_stress
