#include "harness/bench/microbenchmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_bench {
namespace {

using Json = nlohmann::ordered_json;

/// A library that ours is compared with, in all the ways it was timed; its quickest way counts.
struct Peer {
  const char* title;
  std::array<const char*, 2> rows;
};
constexpr std::array peers{Peer{"nanoflann", {"nanoflann", "nanoflann_sorted"}},
                           Peer{"embree", {"embree_alone", "embree_packets"}}};

Json parse(const MicrobenchmarkFile& file) {
  Json document = Json::parse(file.text, nullptr, false);
  if (!document.is_object() || !document.contains("context") || !document["context"].is_object() ||
      !document.contains("benchmarks") || !document["benchmarks"].is_array())
    throw InputError(file.path, "not what a Google Benchmark program writes");
  return document;
}

struct Median {
  std::string name;
  std::int64_t family;
  double cpu_time, nanoseconds;
  std::string unit;
  double items_per_second;  ///< 0 where no items are counted
};

/// The repetitions' median if there were several, else the one run.
std::vector<Median> medians(const Json& merged) {
  std::vector<Median> found;
  for (const Json& run : merged.at("benchmarks")) {
    const int repetitions = run.value("repetitions", 1);
    const bool wanted = repetitions > 1 ? run.value("aggregate_name", "") == "median"
                                        : run.value("run_type", "iteration") == "iteration";
    if (!wanted || run.value("error_occurred", false)) continue;
    const std::string unit = run.value("time_unit", "ns");
    const double scale = unit == "s" ? 1e9 : unit == "ms" ? 1e6 : unit == "us" ? 1e3 : 1;
    const double time = run.at("cpu_time").get<double>();
    found.push_back({run.at("run_name").get<std::string>(), run.value("family_index", std::int64_t{0}), time,
                     time * scale, unit, run.value("items_per_second", 0.0)});
  }
  std::ranges::stable_sort(found, {}, &Median::family);  // repetitions of different benchmarks were interleaved
  return found;
}

/// TASK/`peer`/ARGUMENTS for TASK/anything/ARGUMENTS, else "".
std::string named_after(const std::string& peer, const std::string& name) {
  const std::size_t first = name.find('/');
  const std::size_t second = first == std::string::npos ? first : name.find('/', first + 1);
  return second == std::string::npos ? "" : name.substr(0, first + 1) + peer + name.substr(second);
}

/// Ratio of speeds: by items where both count them, else by the time of one iteration.
double speed_ratio(const Median& ours, const Median& other) {
  if (ours.items_per_second > 0 && other.items_per_second > 0) return ours.items_per_second / other.items_per_second;
  return other.nanoseconds / ours.nanoseconds;
}

bool is_row_of(const Peer& peer, const std::string& name) {
  return std::ranges::any_of(peer.rows, [&](const char* row) { return named_after(row, name) == name; });
}

/// " N x PEER", against the quickest of the peer's rows. Empty if there is none, and for a row of the peer's own.
std::string against(const Peer& peer, const Median& ours, const std::vector<Median>& all) {
  if (is_row_of(peer, ours.name)) return "";
  double least = 0;
  for (const char* row : peer.rows) {
    const auto other = std::ranges::find(all, named_after(row, ours.name), &Median::name);
    if (other == all.end()) continue;
    const double ratio = speed_ratio(ours, *other);
    least = least > 0 ? std::min(least, ratio) : ratio;
  }
  return least > 0 ? fmt::format(" {:>7.2f} x {}", least, peer.title) : "";
}

}  // namespace

std::string merge_microbenchmarks(const std::vector<MicrobenchmarkFile>& files) {
  Json merged;
  std::string executables;
  std::int64_t families = 0;
  for (const MicrobenchmarkFile& file : files) {
    if (file.text.empty()) continue;
    Json document = parse(file);
    if (document["benchmarks"].empty()) continue;
    if (merged.is_null()) merged = {{"context", document["context"]}, {"benchmarks", Json::array()}};
    const std::filesystem::path executable = document["context"].value("executable", file.path);
    executables += (executables.empty() ? "" : " ") + executable.filename().string();
    const std::int64_t before = families;
    for (Json& run : document["benchmarks"]) {
      if (run.contains("family_index")) {
        const std::int64_t family = before + run["family_index"].get<std::int64_t>();
        run["family_index"] = family;
        families = std::max(families, family + 1);
      }
      merged["benchmarks"].push_back(std::move(run));
    }
  }
  if (merged.is_null()) throw InputError("--bench", "no benchmark has a name that matches");
  merged["context"]["executable"] = executables;
  return merged.dump(2) + "\n";
}

std::string microbenchmark_table(const std::string& merged) {
  const std::vector<Median> all = medians(Json::parse(merged));
  std::size_t widest = 0;
  for (const Median& m : all) widest = std::max(widest, m.name.size());
  std::string table;
  for (const Median& m : all) {
    table += fmt::format("{:<{}} {:>10.4g} {:<2}", m.name, widest, m.cpu_time, m.unit);
    table += m.items_per_second > 0 ? fmt::format(" {:>9.4g} M/s", m.items_per_second / 1e6) : std::string(14, ' ');
    // The calling thread's CPU time means nothing when several threads share the work.
    if (m.name.find("threads") == std::string::npos)
      for (const Peer& peer : peers) table += against(peer, m, all);
    while (table.back() == ' ') table.pop_back();
    table += '\n';
  }
  return table;
}

}  // namespace photonproof::inline harness_bench
