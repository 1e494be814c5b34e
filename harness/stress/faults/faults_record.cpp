#include "harness/stress/faults/faults_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/stress/faults/fault_rows.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_stress_faults {
namespace {

using Json = nlohmann::ordered_json;

Json outcome_json(const FaultOutcome& outcome) {
  Json json = {{"work", outcome.work},     {"asked", outcome.asked},         {"count", outcome.count},
               {"trials", outcome.trials}, {"broken", outcome.broken_count}, {"first_broken", outcome.broken}};
  if (!outcome.not_tried.empty()) json["not_tried"] = outcome.not_tried;
  return json;
}

FaultOutcome outcome_of(const std::string& fault, const Json& json) {
  FaultOutcome outcome;
  outcome.fault = fault;
  outcome.work = json.at("work");
  outcome.asked = json.at("asked");
  outcome.count = json.at("count");
  outcome.trials = json.at("trials");
  outcome.broken_count = json.at("broken");
  outcome.broken = json.at("first_broken").get<std::vector<std::string>>();
  outcome.not_tried = json.value("not_tried", "");
  return outcome;
}

/// What all works of a row came to.
struct RowSum {
  int count = 0, broken = 0, works = 0;
  std::string first_broken, not_tried;
};

RowSum sum_of(const FaultsRecord& record, const std::string& fault) {
  RowSum sum;
  for (const FaultOutcome& outcome : record.outcomes) {
    if (outcome.fault != fault) continue;
    ++sum.works;
    sum.count += outcome.count;
    sum.broken += outcome.broken_count;
    if (sum.first_broken.empty() && !outcome.broken.empty()) sum.first_broken = outcome.work + ": " + outcome.broken[0];
    if (sum.not_tried.empty()) sum.not_tried = outcome.not_tried;
  }
  return sum;
}

std::string row_words(const FaultRow& row, const RowSum& sum) {
  if (sum.count == 0 && !sum.not_tried.empty()) return "not tried: " + sum.not_tried;
  if (sum.broken == 0) return fmt::format("{} of {} works held", sum.count, sum.works);
  return fmt::format("{}, of which {} did not hold: {}",
                     row.is_kill ? fmt::format("{} kills", sum.count) : fmt::format("{} trials", sum.count), sum.broken,
                     sum.first_broken);
}

}  // namespace

FaultOutcome& FaultsRecord::of(const std::string& fault, const std::string& work) {
  for (FaultOutcome& outcome : outcomes)
    if (outcome.fault == fault && outcome.work == work) return outcome;
  outcomes.emplace_back();
  outcomes.back().fault = fault;
  outcomes.back().work = work;
  return outcomes.back();
}

bool FaultsRecord::fails() const {
  return std::any_of(outcomes.begin(), outcomes.end(), [](const FaultOutcome& o) { return o.broken_count > 0; });
}

std::string faults_table(const FaultsRecord& record) {
  std::string text;
  int count = 0, kills = 0, broken = 0;
  for (const FaultRow& row : fault_rows()) {
    const RowSum sum = sum_of(record, row.name);
    if (sum.works == 0) continue;
    text += fmt::format("{:<15} {}\n", row.name, row_words(row, sum));
    (row.is_kill ? kills : count) += sum.count;
    broken += sum.broken;
  }
  return text + fmt::format("{}: {} kills and {} other faults in {:.0f} s, {} of which did not hold\n",
                            broken == 0 ? "held" : "failed", kills, count, record.seconds, broken);
}

void write_faults_record(const FaultsRecord& record, const std::filesystem::path& file) {
  Json json = {{"schema_version", 1},
               {"created", record.created},
               {"program", record.program},
               {"checksum", record.checksum},
               {"command", record.command},
               {"host", record.host},
               {"seed", record.seed},
               {"verdict", record.fails() ? "failed" : "held"},
               {"interrupted", record.interrupted},
               {"seconds", record.seconds},
               {"faults", Json::array()}};
  for (const FaultRow& row : fault_rows()) {
    Json rows = Json::array();
    for (const FaultOutcome& outcome : record.outcomes)
      if (outcome.fault == row.name) rows.push_back(outcome_json(outcome));
    if (rows.empty()) continue;
    json["faults"].push_back({{"name", row.name}, {"done", row.done}, {"must_hold", row.must_hold}, {"works", rows}});
  }
  write_file_atomically(file, json_text(json) + "\n");
}

FaultsRecord read_faults_record(const std::filesystem::path& file) {
  const Json json = Json::parse(read_file(file), nullptr, false);
  try {
    FaultsRecord record;
    record.created = json.at("created");
    record.program = json.at("program");
    record.checksum = json.at("checksum");
    record.command = json.at("command");
    record.host = json.at("host");
    record.seed = json.at("seed");
    record.seconds = json.at("seconds");
    record.interrupted = json.at("interrupted");
    for (const Json& row : json.at("faults"))
      for (const Json& work : row.at("works")) record.outcomes.push_back(outcome_of(row.at("name"), work));
    return record;
  } catch (const Json::exception&) {
    throw InputError(file.string(), "is no record of faults");
  }
}

}  // namespace photonproof::inline harness_stress_faults
