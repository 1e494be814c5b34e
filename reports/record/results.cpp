#include "reports/record/results.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "reports/record/file_inside.h"
#include "reports/record/results_json.h"
#include "reports/record/results_schema.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_record {
namespace {

using nlohmann::json;

constexpr std::size_t max_file_bytes = std::size_t{1} << 28;

constexpr std::array<std::pair<Status, const char*>, 6> status_names{{{Status::ok, "ok"},
                                                                      {Status::timeout, "timeout"},
                                                                      {Status::crash, "crash"},
                                                                      {Status::bad_image, "bad_image"},
                                                                      {Status::unsupported, "unsupported"},
                                                                      {Status::not_started, "not_started"}}};

json parse(const std::string& path) {
  const std::string text = read_file(path, max_file_bytes);
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    // nlohmann counts the byte that it choked on from 1.
    const std::size_t at = std::min(text.size(), error.byte == 0 ? 0 : error.byte - 1);
    const std::size_t line_start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw InputError(path, static_cast<int>(line), static_cast<int>(at - line_start) + 1,
                     at == text.size() ? "not valid JSON: the file ends in the middle" : "not valid JSON");
  } catch (const json::out_of_range&) {
    throw InputError(path, "not valid JSON: a number is too large for a double");
  }
}

// The version first: a file of another version may break the schema in any way.
json read_validated(const std::string& path, ResultsDocument kind) {
  json document = parse(path);
  const auto version = document.is_object() ? document.find("schema_version") : document.end();
  if (version == document.end() || !version->is_number_integer())
    throw InputError(path, "not a results file: it has no schema_version");
  if (*version != results_schema_version)
    throw InputError(path, "has schema_version " + version->dump() + "; this program reads " +
                               std::to_string(results_schema_version));
  validate_results(document, kind, path);
  return document;
}

void write_validated(const std::string& path, const json& document, ResultsDocument kind) {
  validate_results(document, kind, path);
  // An engine may print anything: bytes that are not UTF-8 become U+FFFD.
  write_file_atomically(path, document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace

std::string to_string(Status status) {
  for (const auto& [value, name] : status_names)
    if (value == status) return name;
  return {};
}

Status status_from_string(const std::string& name) {
  for (const auto& [value, known] : status_names)
    if (name == known) return value;
  throw InputError(name, "not a status; expected ok, timeout, crash, bad_image or unsupported");
}

std::string to_string(GateVerdict verdict) {
  constexpr const char* names[] = {"pass", "fail", "inconclusive"};
  return names[static_cast<int>(verdict)];
}

std::string to_string(Correctness correctness) {
  constexpr const char* names[] = {"right", "noisy", "biased", "unknown"};
  return names[static_cast<int>(correctness)];
}

std::string to_string(Clock clock) { return clock == Clock::wall ? "wall" : "processor"; }

std::optional<Clock> clock_from_string(const std::string& name) {
  for (const Clock clock : {Clock::wall, Clock::processor})
    if (name == to_string(clock)) return clock;
  return std::nullopt;
}

std::optional<double> seconds_by(Clock clock, const Result& result) {
  return clock == Clock::wall ? result.wall_seconds : result.cpu_seconds;
}

std::string to_string(Change change) {
  constexpr const char* names[] = {"regression", "improvement", "unchanged", "inconclusive"};
  return names[static_cast<int>(change)];
}

std::string Budget::amount_text() const {
  // Whole numbers in full (1000000, not 1e+06): engines take them as integers. 2^53 is where doubles stop counting.
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

namespace {

void refuse_links_outside_of(const std::filesystem::path& folder, const Results& results) {
  for (const SceneRecord& scene : results.scenes) {
    if (!scene.reference) continue;
    refuse_link_outside(folder, scene.reference->image);
    refuse_link_outside(folder, scene.reference->picture);
  }
  for (const Result& result : results.results) {
    refuse_link_outside(folder, result.image);
    refuse_links_outside(folder, result.pictures);
  }
  for (const GateRecord& gate : results.gates) {
    refuse_link_outside(folder, gate.image);
    refuse_links_outside(folder, gate.pictures);
  }
}

}  // namespace

Results read_results(const std::string& path) {
  Results results = results_from_json(read_validated(path, ResultsDocument::run));
  refuse_links_outside_of(std::filesystem::absolute(path).parent_path(), results);
  std::set<std::string> labels;
  for (const Result& result : results.results)
    if (!labels.insert(result.cell.label()).second)
      throw InputError(path, "has two results for '" + result.cell.label() + "'");
  return results;
}

void write_results(const std::string& path, const Results& results) {
  write_validated(path, results_to_json(results), ResultsDocument::run);
}

KeptResult read_result(const std::string& path) {
  const json document = read_validated(path, ResultsDocument::single_result);
  return {result_from_json(document.at("result")), document.at("comparison_key")};
}

void write_result(const std::string& path, const KeptResult& kept) {
  write_validated(path,
                  {{"schema_version", results_schema_version},
                   {"comparison_key", kept.comparison_key},
                   {"result", result_to_json(kept.result)}},
                  ResultsDocument::single_result);
}

}  // namespace photonproof::inline reports_record
