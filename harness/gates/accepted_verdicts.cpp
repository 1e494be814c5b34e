#include "harness/gates/accepted_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "harness/cells/cells.h"
#include "harness/pixels/repeated_images.h"
#include "judging_hash.h"
#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline harness_gates {
namespace {

namespace fs = std::filesystem;

std::string checksum_of(const Image& image) {
  const std::string_view bytes = bytes_of(image);
  Checksum checksum;
  checksum.add(bytes.data(), bytes.size());
  return size_text(image.width, image.height) + " " + checksum.hex();
}

/// Lists all members of a gate, so that none is forgotten: else a pass would be kept for another value of it. The
/// reference identifies the scene. The images' origin and the metric's parameters, which the scene shares, are keyed
/// separately.
std::string settings_of(const Gate& gate) {
  const auto& [name, scene, engine, budget, metric, bound, block_bound, alpha, seeds, looks, takes_seed, unbiased,
               parameters] = gate;
  return fmt::format("{} {} {} {} {} {} {} {}", metric, bound, block_bound, alpha, seeds, looks, takes_seed, unbiased);
}

fs::path file_of(const std::string& key) { return cache_folder() / "verdicts" / (key + ".json"); }

}  // namespace

std::size_t images_to_accept(const GateSuite& suite, const Gate& gate) {
  const auto first = std::ranges::find(suite.gates, gate.engine, &Gate::engine);
  const bool shows_that_seeds_count = first != suite.gates.end() && stream_label(*first) == stream_label(gate);
  return static_cast<std::size_t>(std::min(shows_that_seeds_count ? 2 : 1, gate.seeds));
}

std::string verdict_key(const Gate& gate, const GateSuite& suite, const StoredReference& reference,
                        const ParameterValues& viewing, std::span<const std::unique_ptr<DrawnImage>> first_images) {
  std::vector<std::string> images;
  for (const auto& drawn : first_images)
    images.push_back(std::to_string(drawn->result.cell.seed) + " " + checksum_of(drawn->image));
  return content_key({{"gate", gate.name},
                      {"settings", settings_of(gate)},
                      {"engine", gate.engine + engine_content(suite.engine(gate.engine))},
                      {"budget", gate.budget.label()},
                      {"threads", std::to_string(suite.limits.threads)},
                      {"reference", provenance_text(reference.provenance)},
                      {"parameters", values_text(parameters_of(gate, viewing))},
                      {"judging", PHOTONPROOF_SOURCE_HASH},
                      {"images", length_prefixed(images)}});
}

std::optional<Results> find_accepted(const std::string& key) {
  try {
    Results kept = read_results(file_of(key).string());
    if (kept.gates.size() == 1 && kept.gates[0].verdict == GateVerdict::pass) return kept;
  } catch (const InputError&) {
    // A missing or damaged record counts as never accepted.
  }
  return std::nullopt;
}

void keep_accepted(const std::string& key, Results run, GateRecord passed) {
  passed.image.clear();
  passed.pictures.clear();
  std::erase_if(run.engines, [&](const EngineRecord& engine) { return engine.name != passed.engine; });
  std::erase_if(run.scenes, [&](const SceneRecord& scene) { return scene.name != passed.scene; });
  run.gates = {std::move(passed)};
  const fs::path file = file_of(key);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw InputError(file.parent_path().string(), "cannot be made: " + error.message());
  write_results(file.string(), run);
}

}  // namespace photonproof::inline harness_gates
