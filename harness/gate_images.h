// The images that gates look at: an engine's, of one scene and budget, one independent image a seed. Each is a process
// of its own; several run side by side. Gates on the same stream share its images.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/cell_store.h"
#include "harness/gate_suite.h"
#include "harness/scene_copies.h"
#include "scenes/image.h"

namespace photonproof {

/// One image and what came of drawing it. `result.status` other than ok leaves the image empty.
struct DrawnImage {
  Image image;
  Result result;
};

struct DrawOptions {
  std::filesystem::path program;       ///< this program, or a faulty one
  std::filesystem::path folder;        ///< receives cells/ (cell_store.h); exists
  std::uint64_t seed = 1;              ///< of the whole run: another one draws other images
  std::string fault{};                 ///< planted in `program`, which is photonproof-faulty (scenes/faults.h)
  std::vector<std::string> further{};  ///< arguments after the engine's own
  int processes = 1;                   ///< side by side
  bool resume = false;                 ///< use what an earlier run left in `folder`
  bool keep = true;                    ///< leave the images in `folder`
  const std::atomic<bool>* interrupt = nullptr;
  SceneCopies* copies = nullptr;  ///< what engines are given of scenes; null: the scenes themselves
};

/// What decides an image, but for its seed.
struct StreamContent {
  std::string scene_hash, engine_version;
};

/// The images of one stream, drawn when they are asked for.
class ImageStream {
 public:
  /// `gate` says scene, engine and budget; `avoided` are the reference's seeds. Refers to suite and options.
  ImageStream(const GateSuite& suite, const Gate& gate, StreamContent content, std::vector<std::uint64_t> avoided,
              const DrawOptions& options);

  /// Draws until there are `count`, or one is not ok: it is the last, then. False when interrupted.
  bool draw(std::size_t count);

  const std::vector<std::unique_ptr<DrawnImage>>& drawn() const { return drawn_; }
  /// The first that is not ok; null when all are.
  const DrawnImage* failed() const;

 private:
  std::unique_ptr<DrawnImage> draw_one(std::uint64_t seed) const;
  std::uint64_t next_seed();

  const GateSuite& suite_;
  const SuiteScene& scene_;
  const Engine& engine_;
  Budget budget_;
  StreamContent content_;
  std::vector<std::uint64_t> avoided_;
  const DrawOptions& options_;
  CellStore store_;
  std::string file_content_;  ///< of the engine's own file of the scene
  std::uint64_t seed_;
  std::vector<std::unique_ptr<DrawnImage>> drawn_;
};

/// The same stream means the same images.
std::string stream_label(const Gate& gate);

}  // namespace photonproof
