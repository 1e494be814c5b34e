// Renders a scene description with one of our own engines: `photonproof render` as a process, run like any other
// program. Predictions of variants and diagnoses use it.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/images/image_store.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_variants {

struct OwnEngine {
  std::filesystem::path program;                 ///< photonproof
  const std::atomic<bool>* interrupt = nullptr;  ///< ends a running render
  double seconds = 300;                          ///< limit for one render
  std::shared_ptr<ImageStore> kept{};            ///< receives renderings, by all that they follow from; null: none
};

struct OwnRender {
  int width = 64, height = 64;
  int spp = 64;
  std::uint64_t seed = 1;
  std::string integrator = "path";     ///< empty: the scene's own, with its parameters
  std::vector<std::string> more = {};  ///< arguments of `photonproof render`
};

/// Linear radiance, with variance. May be called on several threads. Throws InputError when the program fails.
Rendering render_with(const OwnEngine& engine, const SceneDescription& scene, const OwnRender& render);

}  // namespace photonproof::inline harness_variants
