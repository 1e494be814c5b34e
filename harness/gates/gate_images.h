// The images of gates: one engine's, of one scene and budget, one independent image a seed. A process of its own draws
// each; several run side by side. Gates on the same stream share its images.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/gates/gate_suite.h"
#include "harness/images/image_source.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_gates {

/// One image and its result. With a `result.status` other than ok the image is empty.
struct DrawnImage {
  Image image;
  Result result;
};

struct DrawOptions {
  std::filesystem::path program;       ///< This program, or a faulty one.
  std::filesystem::path folder;        ///< Receives cells/ (image_store.h); exists.
  std::uint64_t seed = 1;              ///< Seed of the whole run: another one draws other images.
  std::string fault{};                 ///< Planted in `program`, which is photonproof-faulty (scenes/base/faults.h).
  std::vector<std::string> further{};  ///< Arguments after the engine's own.
  int processes = 1;                   ///< Number of processes at once.
  bool resume = false;                 ///< Use the images of an earlier run in `folder`.
  const std::atomic<bool>* interrupt = nullptr;
  SceneCopies* copies = nullptr;  ///< The scene copies that engines get; null: the scenes themselves.
};

/// All inputs of an image except its seed.
struct StreamContent {
  std::string scene_hash, engine_version;
  std::optional<FilmPart> crop{};
};

class ImageStream;

/// A stream and the number of images that it must have.
struct StreamDemand {
  ImageStream* stream = nullptr;
  std::size_t count = 0;
};

/// Draws until every stream has its `count`, or an image that is not ok, which then is its last. Draws the images of
/// all streams, `processes` at a time. Calls `progress` after each, from one thread at a time. False when interrupted.
bool draw_streams(std::span<const StreamDemand> demands, int processes,
                  const std::function<void(std::size_t done, std::size_t total)>& progress = {});

/// The images of one stream, drawn on request.
class ImageStream {
 public:
  /// `gate` gives scene, engine and budget; `avoided` are the reference's seeds. Refers to suite and options.
  ImageStream(const GateSuite& suite, const Gate& gate, StreamContent content, std::vector<std::uint64_t> avoided,
              const DrawOptions& options);

  /// Calls draw_streams for this stream.
  bool draw(std::size_t count);

  const std::vector<std::unique_ptr<DrawnImage>>& drawn() const { return drawn_; }
  /// The first image that is not ok; null when all are.
  const DrawnImage* failed() const;

 private:
  friend bool draw_streams(std::span<const StreamDemand>, int, const std::function<void(std::size_t, std::size_t)>&);

  std::unique_ptr<DrawnImage> draw_one(std::uint64_t seed);
  std::uint64_t next_seed();
  /// False when images are missing without a failure: interrupted.
  bool append(std::span<std::unique_ptr<DrawnImage>> fresh);

  ImageEngine engine_;
  ImageScene scene_;
  Budget budget_;
  std::vector<std::uint64_t> avoided_;
  int processes_;
  ImageSource source_;
  std::uint64_t seed_;
  std::vector<std::unique_ptr<DrawnImage>> drawn_;
};

/// The label of a stream: equal labels have equal images.
std::string stream_label(const Gate& gate);

}  // namespace photonproof::inline harness_gates
