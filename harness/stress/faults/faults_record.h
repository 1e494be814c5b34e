// What befell the works, and what came of it: the record faults.json, from which an interrupted run goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

/// One fault on one work.
struct FaultOutcome {
  std::string fault, work;
  int trials = 0;                   ///< decided ones; the next has this number
  int count = 0;                    ///< faults that befell in them: kills, or one a trial
  int asked = 0;                    ///< trials, or kills
  int broken_count = 0;             ///< trials in which something did not hold
  std::vector<std::string> broken;  ///< what, the first few
  std::string not_tried;            ///< why this machine cannot; empty where it was tried
};

struct FaultsRecord {
  std::string created, program, checksum, command, host;
  std::uint64_t seed = 1;
  std::vector<FaultOutcome> outcomes;
  double seconds = 0;  ///< of all runs into this record
  bool interrupted = false;

  FaultOutcome& of(const std::string& fault, const std::string& work);
  bool fails() const;
};

/// A line a fault, and one for all.
std::string faults_table(const FaultsRecord& record);

void write_faults_record(const FaultsRecord& record, const std::filesystem::path& file);
/// Throws InputError where it is no such record.
FaultsRecord read_faults_record(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_stress_faults
