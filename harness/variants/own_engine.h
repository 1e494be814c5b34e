// One of our own engines renders a scene that a description says: `photonproof render` as a process, as anybody's
// program is run. For predictions of variants and for what diagnoses compare with.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/images/image_store.h"
#include "harness/suites/engines.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_variants {

struct OwnEngine {
  std::filesystem::path program;                 ///< photonproof
  const std::atomic<bool>* interrupt = nullptr;  ///< ends a render that runs
  double seconds = 300;                          ///< a render's limit
  std::shared_ptr<ImageStore> kept{};            ///< renderings are kept there, by all they follow from; null: nowhere
};

struct OwnRender {
  int width = 64, height = 64;
  int spp = 64;
  std::uint64_t seed = 1;
  std::string integrator = "path";     ///< empty: the scene's own, with its parameters
  std::vector<std::string> more = {};  ///< arguments of `photonproof render`
};

/// That render as an engine, to whose command `more` is added.
Engine own_row(const OwnRender& render);

/// Linear radiance, with variance. May be called on several threads. Throws InputError when the program fails.
Rendering render_with(const OwnEngine& engine, const SceneDescription& scene, const OwnRender& render);

}  // namespace photonproof::inline harness_variants
