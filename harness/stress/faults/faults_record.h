// The record faults.json of all faults and their outcomes. An interrupted run resumes from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

/// One fault on one work.
struct FaultOutcome {
  std::string fault, work;
  int trials = 0;                   ///< Decided trials; the next has this number.
  int count = 0;                    ///< Faults that occurred in them: kills, or one a trial.
  int asked = 0;                    ///< Requested trials, or kills.
  int broken_count = 0;             ///< Trials in which something did not hold.
  std::vector<std::string> broken;  ///< The first few of these, a sentence each.
  std::string not_tried;            ///< Why this machine cannot try it; empty where it did.
};

struct FaultsRecord {
  std::string created, program, checksum, command, host;
  std::uint64_t seed = 1;
  std::vector<FaultOutcome> outcomes;
  double seconds = 0;  ///< Time of all runs into this record.
  bool interrupted = false;

  FaultOutcome& of(const std::string& fault, const std::string& work);
  bool fails() const;
};

/// A line for each fault, and one for all together.
std::string faults_table(const FaultsRecord& record);

void write_faults_record(const FaultsRecord& record, const std::filesystem::path& file);
/// Throws InputError where the file is no such record.
FaultsRecord read_faults_record(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_stress_faults
