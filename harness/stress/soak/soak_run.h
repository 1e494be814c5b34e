// Renders small scenes again and again in one folder: each time in its own process, then all of them once more within
// one process. Memory, files and disk must not grow, and every image must have the same bits each time.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/stress/soak/soak_record.h"

namespace photonproof::inline harness_stress_soak {

/// A way to render: an integrator, with or without options.
struct SoakMethod {
  std::string name;                    ///< "photonmapper --indirect cache".
  std::vector<std::string> arguments;  ///< Arguments of `photonproof render`.
};

struct SoakOptions {
  std::filesystem::path folder;   ///< Receives everything; images left by another run are removed first.
  std::filesystem::path program;  ///< The program photonproof.
  std::filesystem::path within;   ///< The program photonproof-trials of the same build, which renders within one
                                  ///< process.
  std::vector<SoakMethod> methods;
  std::uint64_t renders = 1000;  ///< At least this many by processes, rounded up to whole cycles, and as many within
                                 ///< one.
  double memory_bound = 4096;    ///< Bytes a render.
  std::uint64_t seed = 1;        ///< Seed of every image.
  std::string command, version;  ///< For the record.
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(std::uint64_t done, std::uint64_t all)> progress{};
};

/// Writes soak.json. Throws InputError where the folder cannot be used, or no kind can be rendered.
SoakRecord run_soak(const SoakOptions& options);

/// The half within one process, which run_soak starts. `render` makes the image of a line of `folder`/within.json, once
/// a cycle. The memory of the process after every cycle, and each image's checksum, go to `folder`/within-samples.json.
void soak_within(const std::filesystem::path& folder,
                 const std::function<void(const std::vector<std::string>& arguments)>& render);

}  // namespace photonproof::inline harness_stress_soak
