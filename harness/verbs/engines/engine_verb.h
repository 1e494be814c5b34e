// The parts that verbs which render with another engine share: their options, and what they write and print.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_engines {

struct EngineOutputs {
  std::string stats_path;
  bool json = false;
  std::string progress = "auto";
};

/// --stats, in the group of the options before.
void add_stats_option(CLI::App& verb, EngineOutputs& outputs);
/// -o and --stats in a group of their own.
void add_output_options(CLI::App& verb, std::string& image, EngineOutputs& outputs);
/// --spp and --seed of an engine that samples, in the group "Method".
void add_sample_options(CLI::App& verb, int& samples, std::uint64_t& seed);
/// --threads.
void add_threads_option(CLI::App& verb, int& threads);
/// --json and the options of progress.
void add_report_options(CLI::App& verb, EngineOutputs& outputs);

/// Writes the image and its stats; prints the stats or `lines`, and the defects on standard error.
void write_engine_outputs(const std::string& image, const std::string& stats_path, const Rendering& rendering,
                          const nlohmann::ordered_json& stats, const std::string& lines, bool json,
                          const std::vector<std::string>& defects);

}  // namespace photonproof::inline harness_verbs_engines
