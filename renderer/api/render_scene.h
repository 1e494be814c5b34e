// The renderer as a library: a scene description and a request in, an image and its stats out. The command `render` is
// this function between a command line and files.
// ```
//   const SceneDescription scene = parse_scene_file("scene.xml");
//   const Rendered rendered = render_scene(scene, {.integrator = "photonmapper", .budget = {.spp = 64}});
//   write_exr("image.exr", rendered.image);
// ```
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/limits/scene_notes.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/plan.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_api {

/// Asks for the render's image to be filtered by Open Image Denoise, which makes it biased.
struct DenoiseRequest {
  /// The library's file or folder. Empty: beside the program, or where the system's loader finds it.
  std::string library{};
};

struct RenderRequest {
  std::string integrator{};                 ///< A name of `integrators()`. Empty: the scene's own.
  std::optional<IndirectLight> indirect{};  ///< The photon mapper's. Empty: the scene's own.
  RenderBudget budget{};                    ///< Empty: the scene's samples per pixel.
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: every core. The image does not depend on it.
  int grid = 0;     ///< k > 0: samples on the centres of a k x k grid in each pixel
  SamplerKind sampler = SamplerKind::sobol;
  Aov view = Aov::whole;
  std::vector<std::string> no_skip{};           ///< Names of skip_table() to switch off, or "all".
  std::string isa{};                            ///< Instruction set of the kernels. Empty: the processor's best.
  std::optional<FilmDescription::Crop> crop{};  ///< Pixels of the whole image. Empty: the scene's own.
  std::optional<DenoiseRequest> denoise{};      ///< Empty: the image stays as it was rendered.

  /// Names the caller's changes to the description after it was read. Checkpoints with other changes do not fit.
  std::string preset{};
  /// render_scene fills in `identity`. The file stays after a complete render, too: the caller removes it by
  /// remove_checkpoint once the image is stored.
  std::optional<CheckpointPolicy> checkpoint{};
  const std::atomic<bool>* interrupt = nullptr;                               ///< true ends the render early
  std::function<void(double fraction, const std::string& phase)> progress{};  ///< from one thread at a time
  /// Gets the mean so far, every `preview_seconds` or less often, and at last the whole image. Rendering waits for it.
  std::function<void(const Image& mean)> preview{};
  double preview_seconds = 1;
  std::function<void(const SceneNote& warning)> warn{};  ///< as early as possible; RenderStats::losses has all
};

/// The filter of a denoised image.
struct Denoised {
  std::string library, version;  ///< "Open Image Denoise", "2.5.1"
  double seconds = 0;            ///< of the guides and the filter; wall time
  int guide_samples = 0;         ///< camera samples a pixel of the guides
};

struct Rendered {
  Rendering image;  ///< radiance, linear Rec. 709: mean, variance of the mean, alpha where the film has it
  RenderPlan plan;
  RenderStats stats;                   ///< with `interrupted`, the image is that of the samples so far
  int threads = 0;                     ///< the number that rendered
  std::size_t unsampled_pixels = 0;    ///< black without a sample, after an interrupt
  std::size_t non_finite_values = 0;   ///< values of the mean
  std::optional<Denoised> denoised{};  ///< Present where the image is filtered. It has no variance then.
  /// Why an image that was to be denoised is not, in a sentence. It is then as it was rendered. Empty: no such failure.
  std::string not_denoised{};
};

/// Renders until the budget or an interrupt ends it. Same description, request and budget in samples or photons: same
/// bits, for any number of threads.
/// Throws InputError where the scene or the request cannot be rendered, before anything is written. Its place is in the
/// scene file or the command line's option ("--crop").
Rendered render_scene(const SceneDescription& description, const RenderRequest& request);

/// The plan that render_scene follows; renders nothing. Throws InputError as render_scene does.
RenderPlan plan_scene(const SceneDescription& description, const RenderRequest& request);

/// Removes the file of a checkpoint, so that the render cannot be resumed.
void remove_checkpoint(const std::filesystem::path& file);

}  // namespace photonproof::inline renderer_api
