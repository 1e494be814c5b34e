#include "reports/stress/stress_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "reports/record/file_inside.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_stress {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<RungOutcome, const char*>, 6> outcome_words{
    {{RungOutcome::right, "right"},
     {RungOutcome::degraded, "degraded"},
     {RungOutcome::refused, "refused"},
     {RungOutcome::undecided, "undecided"},
     {RungOutcome::silently_wrong, "silently wrong"},
     {RungOutcome::crashed, "crashed"}}};

Json rung_json(const StressRung& rung) {
  Json json = {{"height", rung.height},
               {"outcome", to_string(rung.outcome)},
               {"sentence", rung.sentence},
               {"seconds", rung.seconds}};
  if (rung.would_see) json["would_see"] = *rung.would_see;
  if (!rung.picture.empty()) json["picture"] = rung.picture;
  if (!rung.expected.empty()) json["expected"] = rung.expected;
  return json;
}

StressRung rung_of(const Json& json) {
  StressRung rung;
  rung.height = json.at("height");
  rung.outcome = rung_outcome_from(json.at("outcome"));
  rung.sentence = json.at("sentence");
  rung.seconds = json.at("seconds");
  if (json.contains("would_see")) rung.would_see = json["would_see"].get<double>();
  rung.picture = file_inside(json.value("picture", ""));
  rung.expected = file_inside(json.value("expected", ""));
  return rung;
}

Json stress_ladder_json(const StressLadder& ladder) {
  Json json = {{"feature", ladder.feature}, {"climb", ladder.climb},   {"engine", ladder.engine},
               {"measure", ladder.measure}, {"wanted", ladder.wanted}, {"rungs", Json::array()}};
  if (!ladder.not_climbed.empty()) json["not_climbed"] = ladder.not_climbed;
  if (const auto right = ladder.right_up_to()) json["right_up_to"] = *right;
  if (const StressRung* broken = ladder.breakdown()) json["breakdown"] = broken->height;
  for (const StressRung& rung : ladder.rungs) json["rungs"].push_back(rung_json(rung));
  return json;
}

StressLadder stress_ladder_of(const Json& json) {
  StressLadder ladder;
  ladder.feature = json.at("feature");
  ladder.climb = json.at("climb");
  ladder.engine = json.at("engine");
  ladder.measure = json.at("measure");
  ladder.wanted = json.at("wanted");
  ladder.not_climbed = json.value("not_climbed", "");
  for (const Json& rung : json.at("rungs")) ladder.rungs.push_back(rung_of(rung));
  return ladder;
}

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

std::string to_string(RungOutcome outcome) {
  for (const auto& [value, word] : outcome_words)
    if (value == outcome) return word;
  return "";
}

RungOutcome rung_outcome_from(const std::string& text) {
  for (const auto& [value, word] : outcome_words)
    if (text == word) return value;
  throw InputError("outcome", "'" + text + "' is none of a rung");
}

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

std::string rung_text(const StressRung& rung) { return json_text(rung_json(rung)) + "\n"; }

std::optional<StressRung> rung_from_text(const std::string& text) {
  try {
    return rung_of(Json::parse(text));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void write_stress_record(const StressRecord& record, const std::filesystem::path& file) {
  Json json = {{"schema_version", record.schema_version},
               {"created", record.created},
               {"program", record.program},
               {"checksum", record.checksum},
               {"host", record.host},
               {"command", record.command},
               {"quick", record.quick},
               {"interrupted", record.interrupted},
               {"seconds", record.seconds},
               {"ladders", Json::array()}};
  for (const StressLadder& ladder : record.ladders) json["ladders"].push_back(stress_ladder_json(ladder));
  write_file_atomically(file, json_text(json) + "\n");
}

StressRecord read_stress_record(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    const Json json = Json::parse(text);
    StressRecord record;
    record.schema_version = json.at("schema_version");
    if (record.schema_version != 1) throw InputError(file.string(), "is a stress record of another schema than 1");
    record.created = json.at("created");
    record.program = json.at("program");
    record.checksum = json.at("checksum");
    record.host = json.at("host");
    record.command = json.at("command");
    record.quick = json.at("quick");
    record.interrupted = json.at("interrupted");
    record.seconds = json.at("seconds");
    for (const Json& ladder : json.at("ladders")) record.ladders.push_back(stress_ladder_of(ladder));
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    for (const StressLadder& ladder : record.ladders)
      for (const StressRung& rung : ladder.rungs)
        for (const std::string& name : {rung.picture, rung.expected}) refuse_link_outside(folder, name);
    return record;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string(), "is no record of photonproof stress");
  }
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
