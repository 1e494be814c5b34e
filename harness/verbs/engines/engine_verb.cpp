#include "harness/verbs/engines/engine_verb.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs_engines {

void add_stats_option(CLI::App& verb, EngineOutputs& outputs) {
  verb.add_option("--stats", outputs.stats_path, "stats JSON to write (default: beside the EXR, as .stats.json)");
}

void add_output_options(CLI::App& verb, std::string& image, EngineOutputs& outputs) {
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", image, "EXR to write")->required();
  add_stats_option(verb, outputs);
}

void add_sample_options(CLI::App& verb, int& samples, std::uint64_t& seed) {
  begin_option_group(verb, "Method");
  verb.add_option("--spp", samples, "samples per pixel (default: the scene's)")
      ->transform(whole_number(1, 1 << 24))
      ->type_name("N");
  verb.add_option("--seed", seed, "same seed, same samples; the last bits of the image may differ")->check(is_seed);
}

void add_threads_option(CLI::App& verb, int& threads) {
  begin_option_group(verb, run_group);
  verb.add_option("--threads", threads, "worker threads (default: every core)")->check(CLI::Range(1, 1024));
}

void add_report_options(CLI::App& verb, EngineOutputs& outputs) {
  begin_option_group(verb, run_group);
  verb.add_flag("--json", outputs.json, "print the stats as JSON");
  add_progress_option(verb, outputs.progress);
  add_quiet_option(verb, outputs.progress);
}

void write_engine_outputs(const std::string& image, const std::string& stats_path, const Rendering& rendering,
                          const nlohmann::ordered_json& stats, const std::string& lines, bool json,
                          const std::vector<std::string>& defects) {
  write_exr(image, rendering);
  write_file_atomically(stats_path, json_text(stats) + "\n");
  std::printf("%s\n", json ? json_text(stats).c_str() : lines.c_str());
  for (const std::string& defect : defects) std::fprintf(stderr, "%s: %s\n", image.c_str(), defect.c_str());
}

}  // namespace photonproof::inline harness_verbs_engines
