// The images that gates look at: an engine's, of one scene and budget, one independent image a seed. Each is a process
// of its own; several run side by side. Gates on the same stream share its images.
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

/// One image and what came of drawing it. `result.status` other than ok leaves the image empty.
struct DrawnImage {
  Image image;
  Result result;
};

struct DrawOptions {
  std::filesystem::path program;       ///< this program, or a faulty one
  std::filesystem::path folder;        ///< receives cells/ (image_store.h); exists
  std::uint64_t seed = 1;              ///< of the whole run: another one draws other images
  std::string fault{};                 ///< planted in `program`, which is photonproof-faulty (scenes/base/faults.h)
  std::vector<std::string> further{};  ///< arguments after the engine's own
  int processes = 1;                   ///< side by side
  bool resume = false;                 ///< use what an earlier run left in `folder`
  const std::atomic<bool>* interrupt = nullptr;
  SceneCopies* copies = nullptr;  ///< what engines are given of scenes; null: the scenes themselves
};

/// What decides an image, but for its seed.
struct StreamContent {
  std::string scene_hash, engine_version;
  std::optional<FilmPart> crop{};
};

class ImageStream;

/// What a stream is asked for.
struct StreamDemand {
  ImageStream* stream = nullptr;
  std::size_t count = 0;
};

/// Draws until every stream has its `count`, or one image that is not ok: it is the stream's last, then. The images of
/// all streams are drawn `processes` at a time; `progress` is called after each, from one thread at a time. False when
/// interrupted.
bool draw_streams(std::span<const StreamDemand> demands, int processes,
                  const std::function<void(std::size_t done, std::size_t total)>& progress = {});

/// The images of one stream, drawn when they are asked for.
class ImageStream {
 public:
  /// `gate` says scene, engine and budget; `avoided` are the reference's seeds. Refers to suite and options.
  ImageStream(const GateSuite& suite, const Gate& gate, StreamContent content, std::vector<std::uint64_t> avoided,
              const DrawOptions& options);

  /// draw_streams of this one.
  bool draw(std::size_t count);

  const std::vector<std::unique_ptr<DrawnImage>>& drawn() const { return drawn_; }
  /// The first that is not ok; null when all are.
  const DrawnImage* failed() const;

 private:
  friend bool draw_streams(std::span<const StreamDemand>, int, const std::function<void(std::size_t, std::size_t)>&);

  std::unique_ptr<DrawnImage> draw_one(std::uint64_t seed);
  std::uint64_t next_seed();
  /// False when images are missing and none says why: interrupted.
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

/// The same stream means the same images.
std::string stream_label(const Gate& gate);

}  // namespace photonproof::inline harness_gates
