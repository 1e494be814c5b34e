// Provides an engine's image of a scene, a budget and a seed. Every image has one key, made from all that decides it,
// and one folder in the store. An image that exists there is not rendered again. The executor decides where the engine
// runs.
#pragma once

#include <atomic>
#include <chrono>
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

/// The use of images, which decides what their key holds besides scene, engine, version, budget, seed, size and the
/// limit on time.
enum class ImageUse {
  measurement,  ///< its time counts: the key adds machine, memory limit and threads
  verdict,      ///< the key adds a planted fault, the memory limit and threads
  estimate      ///< only its expectation counts: the key adds nothing
};

struct ImageSourceOptions {
  ImageUse use = ImageUse::measurement;
  std::filesystem::path folder;          ///< the results folder: receives cells/ (image_store.h); exists
  std::shared_ptr<ImageStore> store{};   ///< the store of that folder, shared by several sources; null: its own
  std::filesystem::path program{};       ///< {photonproof}
  std::filesystem::path suite_folder{};  ///< {suite}
  Limits limits{};                       ///< of one image, with a number of threads
  std::vector<Status> reused{};          ///< `draw` returns a kept result with such a status instead of a new one
  bool resumes = false;                  ///< the engine continues an interrupted image from the files it left
  std::optional<std::chrono::steady_clock::time_point> until{};  ///< then the image at work is interrupted
  const std::atomic<bool>* interrupt = nullptr;
  const Executor* executor = &usual_executor();
  std::function<void(const Cell&)> starts{};  ///< called for each image that `draw` renders anew; may be empty
};

class ImageSource {
 public:
  explicit ImageSource(ImageSourceOptions options);

  /// 32 hexadecimal digits.
  std::string key(const ImageEngine& engine, const ImageScene& scene, const Budget& budget, std::uint64_t seed) const;

  /// The latest kept image of the key, whatever its status.
  std::optional<KeptImage> find(const std::string& key) const { return store_->latest(key); }
  /// Removes the images of that key.
  void remove(const std::string& key) const { store_->remove(key); }

  /// The kept image, or a new one, which is then kept. Its paths are relative to the results folder. Empty when
  /// interrupted: then nothing is kept. May be called on several threads, which share an image that is reused. Throws
  /// InputError where the folder cannot be used.
  std::optional<KeptImage> draw(const ImageEngine& engine, const ImageScene& scene, const Budget& budget,
                                std::uint64_t seed);

  /// The steps of `draw`, for callers that extend a result before they keep it. Claim an empty folder for a new image,
  /// run the engine in it (engine_run.h), then keep its record or replace it.
  std::string claim(const std::string& key) { return store_->claim(key, options_.resumes); }
  void keep(const KeptImage& image) const { store_->keep(image); }
  EngineRun run_of(const std::string& folder, const ImageEngine& engine, const ImageScene& scene, const Budget& budget,
                   std::uint64_t seed) const;

  /// The image of a result with status ok: linear radiance of the crop, or of the whole film without one. Throws
  /// InputError where it cannot be read.
  Rendering image_of(const Result& result) const;
  /// The engine's stats of that image.
  EngineStats stats_of(const KeptImage& image) const;
  /// Whether the time `until` is over.
  bool is_late() const { return options_.until && *options_.until <= std::chrono::steady_clock::now(); }

 private:
  ImageSourceOptions options_;
  std::shared_ptr<ImageStore> store_;
  std::string host_;  ///< where it decides
};

}  // namespace photonproof::inline harness_images
