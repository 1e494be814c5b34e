// Renders small scenes again and again in one folder: each time by a process of its own, then all of it once more
// within one process. Neither memory nor files nor disk may grow, and every image has the same bits each time.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/stress/soak/soak_record.h"

namespace photonproof::inline harness_stress_soak {

/// A way to render: an integrator, or one of its ways.
struct SoakMethod {
  std::string name;                    ///< "photonmapper --indirect cache"
  std::vector<std::string> arguments;  ///< of `photonproof render`
};

struct SoakOptions {
  std::filesystem::path folder;   ///< receives everything; what another run left in its images is removed first
  std::filesystem::path program;  ///< photonproof
  std::filesystem::path within;   ///< photonproof-trials, of the same build, which renders within one process
  std::vector<SoakMethod> methods;
  std::uint64_t renders = 1000;  ///< by processes at least, rounded up to whole cycles, and as many within one
  double memory_bound = 4096;    ///< bytes a render
  std::uint64_t seed = 1;        ///< of every image
  std::string command, version;  ///< for the record
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(std::uint64_t done, std::uint64_t all)> progress{};
};

/// Throws InputError where the folder cannot be used, or no kind can be rendered. soak.json is written.
SoakRecord run_soak(const SoakOptions& options);

/// The half within one process, in a process of its own that run_soak starts: `render` makes the image of a line of
/// `folder`/within.json, once a cycle. What the process holds after every cycle, and each image's checksum, go to
/// `folder`/within-samples.json.
void soak_within(const std::filesystem::path& folder,
                 const std::function<void(const std::vector<std::string>& arguments)>& render);

}  // namespace photonproof::inline harness_stress_soak
