// Draws engines' pictures of a scene, as many samples as a stated power needs, each a process of its own. What is drawn
// is kept in the results folder by all that decides it (harness/images/image_source.h), so that a run goes on where an
// earlier one ended.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/images/image_source.h"
#include "harness/statistics/pooled_pictures.h"
#include "harness/suites/suite.h"
#include "harness/verify/engine_picture.h"
#include "harness/verify/verify_engines.h"
#include "scenes/description/expect.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_verify {

struct EngineRendererOptions {
  std::filesystem::path folder;   ///< exists; receives cells/
  std::filesystem::path program;  ///< this one
  std::filesystem::path rows;     ///< the file with further engines, whose folder is {suite}
  double power = 0.02;            ///< an error of the mean of this much is to be seen
  double seconds = 20;            ///< an engine's pictures of a scene have so long, in processor time a thread
  double quality = 2;             ///< of engines that know qualities
  int first_samples = 64;         ///< a pixel, of the first picture
  int threads = 0;                ///< of each engine; 0: every core
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const std::string& what)> at_work{};
};

/// Thrown when Ctrl-C ended a process: what it was for is not known.
struct VerifyInterrupted {};

/// A scene as verify renders it.
struct RenderedScene {
  std::string name;
  std::filesystem::path file;
  std::string content;  ///< its hash
  int width = 0, height = 0;
  std::optional<Expect> expect{};
  const SceneDescription* description = nullptr;  ///< for what engines cannot show of it; null: unknown
  std::optional<FilmPart> crop{};                 ///< the part that engines render; empty: all of it
};

struct EngineRender {
  std::optional<EnginePicture> picture;
  Status status = Status::ok;  ///< where there is no picture, why
  std::string detail;
  std::string command;  ///< of the last process, as one would type it
};

class EngineRenderer {
 public:
  explicit EngineRenderer(EngineRendererOptions options);

  /// `series`: 0, and 1 for pictures by other random numbers. Throws VerifyInterrupted, and InputError when the results
  /// folder cannot be written.
  EngineRender render(const RenderedScene& scene, const VerifyEngine& engine, int series = 0) const;

  const EngineRendererOptions& options() const { return options_; }

 private:
  KeptImage image(const RenderedScene& scene, const VerifyEngine& engine, const Budget& budget,
                  std::uint64_t seed) const;
  EngineRender render_samples(const RenderedScene& scene, const VerifyEngine& engine, int series) const;

  EngineRendererOptions options_;
  mutable ImageSource source_;
};

/// One engine's pictures taken together (pooled_pictures.h). It declares no error.
EnginePicture pooled_picture(const std::vector<PictureOfSamples>& parts);

/// What an engine declares on a scene: nothing where it is unbiased; else by expect.toml, by its own stats, and no less
/// than what every picture of a biased engine may be off.
DeclaredError declared_error(const VerifyEngine& engine, const std::optional<Expect>& expect, double stated_bias);

}  // namespace photonproof::inline harness_verify
