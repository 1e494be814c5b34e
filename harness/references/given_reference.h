// References of images that none of our own integrators rendered: files that somebody gives, or renders of a suite's
// engine. They serve scenes that only an engine reads, and any other scene of a suite.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/suites/suite.h"
#include "reference/store/reference_store.h"

namespace photonproof::inline harness_references {

struct MadeReference {
  Rendering rendering;
  Provenance provenance;  ///< without versions
};

/// The function that a file's values are encoded by: "srgb", "gamma22" or "linear".
inline constexpr const char* transfers[] = {"srgb", "gamma22", "linear"};

struct GivenFiles {
  std::vector<std::filesystem::path> images;  ///< one, or several of equal weight
  std::filesystem::path variance{};           ///< of the mean; empty: none, or that of the image itself
  /// Empty: values of 8 and 16 bits are sRGB, and floats linear.
  std::string transfer{};
};

/// One image is the reference itself. Its noise is that of a variance image or layer, else unknown. The noise of
/// several images is known from their differences. Throws InputError for files that cannot be read, of another size
/// than the scene, or not finite.
MadeReference reference_from_files(const SuiteScene& scene, const GivenFiles& files);

struct EngineImages {
  const Engine& engine;
  Budget budget;
  int count = 32;  ///< images of independent seeds; 1 where the engine's command has no {seed}
};

struct EngineDraw {
  std::filesystem::path program;  ///< this program
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress{};  ///< may be empty
};

/// The mean of an engine's images. Their seeds begin at 2,000,000,001, which gates do not reach. Empty when
/// interrupted. Throws InputError when an image fails, images of an unbiased engine are all the same, or the engine
/// denoises.
std::optional<MadeReference> reference_by_engine(const SuiteCommon& suite, const SuiteScene& scene,
                                                 const EngineImages& images, const EngineDraw& draw);

/// Puts the reference where reference_of finds it. The reason must state why it replaces a good one. Returns the
/// provenance as it is stored.
Provenance store_reference_of(const SuiteScene& scene, const MadeReference& made, const std::string& reason);

}  // namespace photonproof::inline harness_references
