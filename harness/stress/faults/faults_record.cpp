#include "harness/stress/faults/faults_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "harness/stress/faults/fault_rows.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline harness_stress_faults {

template <class V>
void describe(V& v, FaultOutcome& r) {
  v.record("work");
  v.field("work", r.work);
  v.field("asked", r.asked);
  v.field("count", r.count);
  v.field("trials", r.trials);
  v.field("broken", r.broken_count);
  v.field("first_broken", r.broken);
  v.maybe("not_tried", r.not_tried);
}

namespace {

/// A fault's row and the outcomes of its works, as the record groups them.
struct FaultGroup {
  std::string name, done, must_hold;
  std::vector<FaultOutcome> works{};
};

struct FaultsDocument {
  FaultsRecord record;
  std::vector<FaultGroup> faults{};
};

template <class V>
void describe(V& v, FaultGroup& r) {
  v.record("fault");
  v.field("name", r.name);
  v.field("done", r.done);
  v.field("must_hold", r.must_hold);
  v.field("works", r.works);
}

template <class V>
void describe(V& v, FaultsDocument& r) {
  v.record("photonproof faults");
  v.version("schema_version", 1);
  v.field("created", r.record.created);
  v.field("program", r.record.program);
  v.field("checksum", r.record.checksum);
  v.field("command", r.record.command);
  v.field("host", r.record.host);
  v.field("seed", r.record.seed);
  v.derived("verdict", std::string(r.record.fails() ? "failed" : "held"));
  v.field("interrupted", r.record.interrupted);
  v.field("seconds", r.record.seconds);
  v.field("faults", r.faults);
}

/// The sum over all works of a row.
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
  return fmt::format("{}, {} of them did not hold: {}",
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
  return text + fmt::format("{}: {} kills and {} other faults in {:.0f} s; {} of them did not hold\n",
                            broken == 0 ? "held" : "failed", kills, count, record.seconds, broken);
}

void write_faults_record(const FaultsRecord& record, const std::filesystem::path& file) {
  FaultsDocument document{record};
  for (const FaultRow& row : fault_rows()) {
    FaultGroup group{row.name, row.done, row.must_hold};
    std::ranges::copy_if(record.outcomes, std::back_inserter(group.works),
                         [&](const FaultOutcome& outcome) { return outcome.fault == row.name; });
    if (!group.works.empty()) document.faults.push_back(std::move(group));
  }
  write_file_atomically(file, json_text(record_json(document)) + "\n");
}

FaultsRecord read_faults_record(const std::filesystem::path& file) {
  RecordSource source{file.string()};
  auto document = read_record<FaultsDocument>(parse_record(read_file(file), source.file), source);
  for (const FaultGroup& group : document.faults)
    for (FaultOutcome outcome : group.works) {
      outcome.fault = group.name;
      document.record.outcomes.push_back(std::move(outcome));
    }
  return document.record;
}

}  // namespace photonproof::inline harness_stress_faults
