#include "reports/record/results.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "reports/record/file_inside.h"
#include "reports/record/results_fields.h"
#include "scenes/files/atomic_file.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline reports_record {
namespace {

constexpr std::size_t max_file_bytes = std::size_t{1} << 28;

RecordJson json_of_file(const std::string& path) { return parse_record(read_file(path, max_file_bytes), path); }

/// Written in the form that reading gives, with keys in alphabetical order. An engine may print anything, so bytes that
/// are not UTF-8 become U+FFFD.
template <class T>
void write_file_of(const std::string& path, const T& record) {
  const RecordJson json = record_json(record);
  RecordSource source{path};
  read_record<T>(json, source);
  write_file_atomically(path, nlohmann::json(json).dump(1, ' ', false, RecordJson::error_handler_t::replace) + "\n");
}

}  // namespace

std::string to_string(Status status) { return word_of(status); }
std::string to_string(GateVerdict verdict) { return word_of(verdict); }
std::string to_string(Correctness correctness) { return word_of(correctness); }
std::string to_string(Clock clock) { return word_of(clock); }
std::string to_string(Change change) { return word_of(change); }

Status status_from_string(const std::string& name) {
  if (const auto status = value_of_word<Status>(name)) return *status;
  throw InputError(name, "not a status; expected ok, timeout, crash, bad_image or unsupported");
}

std::optional<Clock> clock_from_string(const std::string& name) { return value_of_word<Clock>(name); }

std::optional<double> seconds_by(Clock clock, const Result& result) {
  return clock == Clock::wall ? result.wall_seconds : result.cpu_seconds;
}

std::string Budget::amount_text() const {
  // Whole numbers in full (1000000, not 1e+06), since engines read them as integers. Above 2^53 doubles skip integers.
  if (amount == std::floor(amount) && std::abs(amount) < 0x1p53) return std::to_string(static_cast<long long>(amount));
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), amount).ptr};
}

std::string Budget::label() const { return kind + "=" + amount_text(); }

std::string Cell::label() const {
  return scene + "/" + engine + "/" + budget.label() + "/seed=" + std::to_string(seed);
}

const Result* Results::find(const std::string& cell_label) const {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [&](const Result& result) { return result.cell.label() == cell_label; });
  return found == results.end() ? nullptr : &*found;
}

Results read_results(const std::string& path) {
  RecordSource source{path};
  Results results = read_record<Results>(json_of_file(path), source);
  refuse_files_outside(source.files, std::filesystem::absolute(path).parent_path());
  std::set<std::string> labels;
  for (const Result& result : results.results)
    if (!labels.insert(result.cell.label()).second)
      throw InputError(path, "has two results for '" + result.cell.label() + "'");
  return results;
}

void write_results(const std::string& path, const Results& results) { write_file_of(path, results); }

KeptResult read_result(const std::string& path) {
  RecordSource source{path};
  KeptResult kept = read_record<KeptResult>(json_of_file(path), source);
  refuse_files_outside(source.files);
  return kept;
}

void write_result(const std::string& path, const KeptResult& kept) { write_file_of(path, kept); }

}  // namespace photonproof::inline reports_record
