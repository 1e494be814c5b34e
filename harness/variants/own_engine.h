// One of our own engines renders a scene that a description says: `photonproof render` as a process, as anybody's
// program is run. For predictions of variants and for what diagnoses compare with.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_variants {

struct OwnEngine {
  std::filesystem::path program;                 ///< photonproof
  const std::atomic<bool>* interrupt = nullptr;  ///< ends a render that runs
  double seconds = 300;                          ///< a render's limit
  std::filesystem::path cache = {};              ///< renderings are kept here, by all they follow from; empty: nowhere
};

struct OwnRender {
  int width = 64, height = 64;
  int spp = 64;
  std::uint64_t seed = 1;
  std::string integrator = "path";     ///< empty: the scene's own, with its parameters
  std::vector<std::string> more = {};  ///< arguments of `photonproof render`
};

std::vector<std::string> render_command(const std::filesystem::path& program, const OwnRender& render,
                                        const std::string& scene, const std::string& out);

/// Linear radiance, with variance. Throws InputError when the program fails.
Rendering render_with(const OwnEngine& engine, const SceneDescription& scene, const OwnRender& render);

}  // namespace photonproof::inline harness_variants
