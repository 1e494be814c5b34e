// Renders engines' pictures of a scene with as many samples as a stated power needs, each in a process of its own.
// Pictures are kept in the results folder by all that decides them (harness/images/image_source.h). So a run continues
// where an earlier one ended.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/cells/scene_copies.h"
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
  std::filesystem::path program;  ///< this program
  std::filesystem::path rows;     ///< the file with more engines, whose folder is {suite}
  double power = 0.02;            ///< relative error of the mean to be detected
  double seconds = 20;            ///< processor time per thread for one engine's pictures of a scene
  double quality = 2;             ///< for engines with a quality setting
  int first_samples = 64;         ///< per pixel, of the first picture
  int threads = 0;                ///< of each engine; 0: every core
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const std::string& what)> at_work{};
};

/// Thrown when Ctrl-C ended a process, so that its result is unknown.
struct VerifyInterrupted {};

/// A scene as verify renders it.
struct RenderedScene {
  std::string name;
  std::filesystem::path file;
  std::string content;  ///< its hash
  int width = 0, height = 0;
  std::optional<Expect> expect{};
  const SceneDescription* description = nullptr;  ///< to find what engines cannot show of it; null: unknown
  std::optional<FilmPart> crop{};                 ///< the rendered part; empty: all of it
  bool has_answers = false;  ///< its folder may hold references and expectations, so engines get a copy without them
};

struct EngineRender {
  std::optional<EnginePicture> picture;
  Status status = Status::ok;  ///< the reason if there is no picture
  std::string detail;
  std::string command;  ///< of the last process, as typed
};

class EngineRenderer {
 public:
  explicit EngineRenderer(EngineRendererOptions options);

  /// `series` 1 gives pictures with other random numbers than 0. Throws VerifyInterrupted, and InputError when the
  /// results folder cannot be written.
  EngineRender render(const RenderedScene& scene, const VerifyEngine& engine, int series = 0) const;

  const EngineRendererOptions& options() const { return options_; }

 private:
  KeptImage image(const RenderedScene& scene, const VerifyEngine& engine, const Budget& budget,
                  std::uint64_t seed) const;
  EngineRender render_samples(const RenderedScene& scene, const VerifyEngine& engine, int series) const;

  EngineRendererOptions options_;
  mutable ImageSource source_;
  mutable SceneCopies copies_;
};

/// One engine's pictures, averaged (pooled_pictures.h). It declares no error.
EnginePicture pooled_picture(const std::vector<PictureOfSamples>& parts);

/// An engine's declared error on a scene: none for an unbiased one. Else the largest of expect.toml's, its own stats'
/// and the allowance for every biased engine.
DeclaredError declared_error(const VerifyEngine& engine, const std::optional<Expect>& expect, double stated_bias);

}  // namespace photonproof::inline harness_verify
