// Gives images: an engine's, of a scene, a budget and a seed. Every image has one key, which holds all that decides it,
// and one folder in the store; an image that is there already is not drawn again. Where the engine runs is the
// executor's affair.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/images/engine_run.h"
#include "harness/images/image_store.h"
#include "harness/suites/engine_stats.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_images {

/// For what images are drawn, which says what decides them beside scene, engine, version, budget, seed, size and the
/// limit on time.
enum class ImageUse {
  measurement,  ///< its time counts: the machine, the memory limit and the number of threads decide, too
  verdict,      ///< so do a planted fault, the memory limit and the number of threads
  estimate      ///< only its expectation counts: nothing else decides
};

struct ImageSourceOptions {
  ImageUse use = ImageUse::measurement;
  std::filesystem::path folder;          ///< the results folder: receives cells/ (image_store.h); exists
  std::shared_ptr<ImageStore> store{};   ///< of that folder, where several sources share it; null: its own
  std::filesystem::path program{};       ///< {photonproof}
  std::filesystem::path suite_folder{};  ///< {suite}
  Limits limits{};                       ///< of one image, with a number of threads
  std::vector<Status> reused{};          ///< `draw` takes a kept result of such a status instead of a new one
  const std::atomic<bool>* interrupt = nullptr;
  const Executor* executor = &usual_executor();
  std::function<void(const Cell&)> starts{};  ///< hears of each image that `draw` makes anew; may be empty
};

class ImageSource {
 public:
  explicit ImageSource(ImageSourceOptions options);

  /// 32 hexadecimal digits.
  std::string key(const ImageEngine& engine, const ImageScene& scene, const Budget& budget, std::uint64_t seed) const;

  /// The latest kept image of the key, whatever its status.
  std::optional<KeptImage> find(const std::string& key) const { return store_->latest(key); }

  /// The kept image, or a new one, which is kept. Its paths are relative to the results folder. Empty when interrupted:
  /// nothing is kept then. May be called on several threads. Throws InputError where the folder cannot be used.
  std::optional<KeptImage> draw(const ImageEngine& engine, const ImageScene& scene, const Budget& budget,
                                std::uint64_t seed);

  /// The parts of `draw`, for those who add to a result before they keep it: an empty folder for a new image; what runs
  /// in it (engine_run.h); its completion, or its record's replacement.
  std::string claim(const std::string& key) { return store_->claim(key); }
  void keep(const KeptImage& image) const { store_->keep(image); }
  EngineRun run_of(const std::string& folder, const ImageEngine& engine, const ImageScene& scene, const Budget& budget,
                   std::uint64_t seed) const;

  /// The image of a result with status ok: linear radiance of the crop, or of the whole film without one. Throws
  /// InputError where it cannot be read.
  Rendering image_of(const Result& result) const;
  /// What the engine said of that image.
  EngineStats stats_of(const KeptImage& image) const;

 private:
  ImageSourceOptions options_;
  std::shared_ptr<ImageStore> store_;
  std::string host_;  ///< where it decides
};

}  // namespace photonproof::inline harness_images
