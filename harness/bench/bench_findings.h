// Findings that need several results of a benchmark: seeds that give the same image, and images that are the reference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_bench {

/// Sentences, in the order of the results:
///   "cornell/mine/spp=16: all 5 seeds gave the same image; its noise is unknown, and need not be zero"
///   "cornell/mine/spp=16: seeds 1, 4 gave the same image, which counts once; ..."
///   "cornell/mine/spp=16/seed=1: its image is the reference itself, bit for bit"
/// The first and third are normal where a scene has no noise. Images are read only where their metrics are equal.
/// Images that cannot be read are left out. `folder` is that of results.json.
std::vector<std::string> findings_of_bench(const Results& results, const std::filesystem::path& folder);

/// Sets "instructions" among the record's versions to "not counted by this kernel" if cells finished and none has a
/// count. Containers and virtual machines often have no counters.
void note_absent_instructions(Results& results);

}  // namespace photonproof::inline harness_bench
