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

int rank(RungOutcome outcome) {
  switch (outcome) {
    case RungOutcome::right:
      return 3;
    case RungOutcome::degraded:
      return 2;
    case RungOutcome::refused:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

std::string to_string(RungOutcome outcome) { return word_of(outcome); }

const StressRung* StressLadder::breakdown() const {
  for (const StressRung& rung : rungs)
    if (is_failure(rung.outcome)) return &rung;
  return nullptr;
}

std::optional<double> StressLadder::right_up_to() const {
  std::optional<double> height;
  for (const StressRung& rung : rungs) {
    if (rung.outcome != RungOutcome::right) break;
    height = rung.height;
  }
  return height;
}

bool StressLadder::reaches_wanted() const {
  return std::all_of(rungs.begin(), rungs.end(), [&](const StressRung& rung) {
    return rung.height > wanted || rung.outcome == RungOutcome::right;
  });
}

std::size_t StressRecord::count(RungOutcome outcome) const {
  std::size_t n = 0;
  for (const StressLadder& ladder : ladders)
    for (const StressRung& rung : ladder.rungs) n += rung.outcome == outcome ? 1 : 0;
  return n;
}

std::string rung_text(const StressRung& rung) { return json_text(record_json(rung)) + "\n"; }

std::optional<StressRung> rung_from_text(const std::string& text) try {
  RecordSource source{"rung"};
  StressRung rung = read_record<StressRung>(parse_record(text, source.file), source);
  refuse_files_outside(source.files);
  return rung;
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

/// What is known of a height: its rung; beyond the last, how that ended the climb; below one that is right, as a quick
/// climb begins there, right.
std::optional<StressRung> rung_at(const StressLadder& ladder, double height) {
  for (const StressRung& rung : ladder.rungs)
    if (rung.height == height) return rung;
  if (ladder.rungs.empty()) return std::nullopt;
  StressRung last = ladder.rungs.back();
  if (height > last.height && (is_failure(last.outcome) || last.outcome == RungOutcome::refused)) return last;
  const std::optional<double> right = ladder.right_up_to();
  if (!right || height > *right) return std::nullopt;
  last.outcome = RungOutcome::right;
  return last;
}

bool is_worse(const StressRung& now, const StressRung& before) {
  return before.outcome != RungOutcome::undecided && now.outcome != RungOutcome::undecided &&
         rank(now.outcome) < rank(before.outcome);
}

std::vector<std::string> steps_of_ladder(const StressLadder& old, const StressLadder& now) {
  std::set<double> heights;
  for (const StressLadder* ladder : {&old, &now})
    for (const StressRung& rung : ladder->rungs) heights.insert(rung.height);
  std::vector<std::string> sentences;
  std::optional<double> told;  // a climb that ended is told once
  for (const double height : heights) {
    const std::optional<StressRung> before = rung_at(old, height), rung = rung_at(now, height);
    if (!before || !rung || !is_worse(*rung, *before) || told == rung->height) continue;
    told = rung->height;
    sentences.push_back(fmt::format("{}, {}, {}, k = {:g}: {} before, now {}: {}", now.feature, now.climb, now.engine,
                                    rung->height, to_string(before->outcome), to_string(rung->outcome),
                                    rung->sentence));
  }
  return sentences;
}

}  // namespace

std::vector<std::string> steps_back(const StressRecord& old, const StressRecord& now) {
  std::vector<std::string> sentences;
  for (const StressLadder& ladder : now.ladders) {
    const auto before = std::find_if(old.ladders.begin(), old.ladders.end(), [&](const StressLadder& other) {
      return other.feature == ladder.feature && other.climb == ladder.climb && other.engine == ladder.engine;
    });
    if (before == old.ladders.end()) continue;
    const std::vector<std::string> own = steps_of_ladder(*before, ladder);
    sentences.insert(sentences.end(), own.begin(), own.end());
  }
  return sentences;
}

}  // namespace photonproof::inline reports_stress
