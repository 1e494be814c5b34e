#include "harness/verbs/render/render_run.h"

#include <cstdio>
#include <filesystem>
#include <optional>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/render/image_output.h"
#include "harness/verbs/render/render_json.h"
#include "harness/verbs/render/render_presets.h"
#include "harness/verbs/render/tev_preview.h"
#include "harness/verbs/usage/progress.h"
#include "renderer/api/render_identity.h"
#include "renderer/api/render_scene.h"
#include "renderer/denoising/oidn_library.h"
#include "renderer/planning/integrator_name.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/timer.h"
#include "scenes/base/utf8.h"
#include "scenes/description/output_files.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs_render {
namespace {

namespace fs = std::filesystem;

/// A scene that was read, what is asked of it, and what the preset did to it.
struct Task {
  SceneDescription scene;
  RenderRequest request;
  std::string preset;  ///< in words; empty: there is none

  void note_preset(RenderPlan& plan) const {
    if (!preset.empty()) plan.runs.insert(plan.runs.begin(), {"preset", preset});
  }
};

RenderRequest request_of(const RenderArguments& arguments, Progress& progress) {
  RenderRequest request;
  request.integrator = arguments.integrator;
  for (const auto& word : indirect_words)
    if (arguments.indirect == word.text) request.indirect = word.value;
  request.budget = {arguments.spp, arguments.photons, arguments.seconds, arguments.target_error};
  request.seed = arguments.seed;
  request.threads = arguments.threads;
  request.grid = arguments.grid;
  request.sampler = arguments.sampler == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
  request.view = aov_named(arguments.view);
  request.no_skip = arguments.no_skip;
  request.isa = arguments.isa;
  if (const std::vector<int>& crop = arguments.crop; !crop.empty()) request.crop = {crop[0], crop[1], crop[2], crop[3]};
  if (arguments.denoise) request.denoise = DenoiseRequest{oidn_in_environment()};
  request.interrupt = &interrupt_flag();
  request.progress = progress.callback();
  request.warn = [](const SceneNote& note) {
    std::fprintf(stderr, "%s: warning: %s\n", note.where.c_str(), note.text.c_str());
  };
  return request;
}

/// Throws InputError where one of `outputs` would replace a file that the scene is read from.
Task read_task(const RenderArguments& arguments, const std::vector<fs::path>& outputs, Progress& progress) {
  Task task{load_scene(arguments.scene), request_of(arguments, progress), {}};
  if (!outputs.empty()) prepare_outputs(outputs, scene_inputs(task.scene));
  const RenderPreset* preset = preset_named(arguments.preset);
  if (preset == nullptr) return task;
  task.request.preset = arguments.preset;
  task.preset = preset->apply(task.scene, !arguments.scene.size.empty());
  const std::string integrator = integrator_name(task.scene.integrator);
  if (!arguments.integrator.empty() && arguments.integrator != integrator)
    throw InputError("--preset", "'" + arguments.preset + "' is of integrator '" + integrator + "', not of '" +
                                     arguments.integrator + "'");
  if (task.request.grid == 0 && task.request.view != Aov::photons) task.request.grid = preset->grid;
  return task;
}

int print_plan(const RenderArguments& arguments) {
  if (arguments.resume) throw InputError("--resume", "does nothing with --plan, which renders nothing");
  if (!arguments.preview.empty()) throw InputError("--preview", "does nothing with --plan, which renders nothing");
  Progress progress("none");
  const Task task = read_task(arguments, {}, progress);
  RenderPlan plan = plan_scene(task.scene, task.request);
  task.note_preset(plan);
  std::printf("%s", arguments.json ? (json_text(plan_json(plan)) + "\n").c_str() : plan_text(plan).c_str());
  return 0;
}

/// With `before`, where it is not the whole image.
std::string view_words(const RenderPlan& plan, const char* before) {
  return plan.view == Aov::whole ? "" : before + std::string(aov_row(plan.view).name);
}

double samples_per_pixel(const RenderStats& stats) { return stats.counts.at("samples_per_pixel"); }

std::string command_line(const RenderArguments& arguments, const Rendered& rendered) {
  return arguments.scene.path + (arguments.scene.as_mitsuba ? " --as-mitsuba" : "") + " --integrator " +
         rendered.plan.integrator + view_words(rendered.plan, " --view ") + " --seed " +
         std::to_string(arguments.seed) + " --spp " +
         std::to_string(static_cast<std::int64_t>(samples_per_pixel(rendered.stats))) +
         (rendered.denoised ? " --denoise" : "");
}

void print_summary(const RenderArguments& arguments, const Rendered& rendered, double seconds) {
  const auto& [image, plan, stats, threads, unsampled, broken, denoised, not_denoised] = rendered;
  std::printf("%s: %s, %dx%d, %.0f samples a pixel, %.2f s\n", arguments.output.c_str(),
              (plan.integrator + view_words(plan, ", view ")).c_str(), image.mean.width, image.mean.height,
              samples_per_pixel(stats), seconds);
  for (const std::string& choice : stats.choices) std::printf("%s\n", choice.c_str());
  if (denoised)
    std::printf("denoised by %s %s in %.2f s: biased, no variance layer\n", denoised->library.c_str(),
                denoised->version.c_str(), denoised->seconds);
  std::string left_out;
  for (const RenderPlan::Decision& d : plan.decisions)
    if (d.skipped) left_out += (left_out.empty() ? "" : ", ") + std::string(skip_row(d.skip).name);
  if (!left_out.empty()) std::printf("skipped %s (--plan prints why)\n", left_out.c_str());
}

/// Prints warnings. Returns the exit code.
int outcome(const RenderArguments& arguments, const Rendered& rendered, const fs::path& checkpoint) {
  const RenderStats& stats = rendered.stats;
  const std::size_t broken = rendered.non_finite_values;
  if (broken > 0) std::fprintf(stderr, "%s: %zu values are not finite\n", arguments.output.c_str(), broken);
  if (!rendered.not_denoised.empty())
    std::fprintf(stderr, "%s: not denoised: %s\n", arguments.output.c_str(), printable(rendered.not_denoised).c_str());
  if (!stats.checkpoint_problem.empty())
    std::fprintf(stderr, "no checkpoint could be left: %s\n", stats.checkpoint_problem.c_str());
  if (!stats.interrupted) return broken > 0 || !rendered.not_denoised.empty() ? 1 : 0;
  std::error_code ignored;
  std::fprintf(stderr, "interrupted: wrote what there was, %.0f samples a pixel at most%s%s\n",
               samples_per_pixel(stats), rendered.unsampled_pixels > 0 ? ", some pixels have none and are black" : "",
               fs::exists(checkpoint, ignored) ? "; --resume goes on from there" : "");
  return 130;
}

int render_to_files(const RenderArguments& arguments) {
  if (arguments.output.empty()) throw InputError("--output", "is required, as the image to write");
  if (output_format(arguments.output) != ImageFormat::png && arguments.exposure)
    throw InputError("--exposure", "is for a PNG, but " + arguments.output + " has the radiance itself");
  const std::string stats_path = stats_path_beside(arguments.stats_path, arguments.output, arguments.scene.path);
  const fs::path checkpoint = arguments.output + ".checkpoint";
  if (same_file(stats_path, checkpoint))
    throw InputError(stats_path, "the stats cannot go to the checkpoint's own file");
  for (const fs::path& file : {fs::path(arguments.output), fs::path(stats_path)}) remove_abandoned_temporaries(file);

  const Timer timer;
  Progress progress(arguments.progress);
  Task task = read_task(arguments, {arguments.output, stats_path, checkpoint}, progress);
  const double load_seconds = timer.seconds();
  std::optional<TevPreview> preview;
  if (!arguments.preview.empty()) {
    preview.emplace(arguments.preview, arguments.output);
    task.request.preview = [&](const Image& mean) { preview->show(mean); };
  }
  task.request.checkpoint = CheckpointPolicy{checkpoint, arguments.checkpoint_seconds, arguments.resume, {}};
  Rendered rendered = render_scene(task.scene, task.request);
  progress.clear();
  task.note_preset(rendered.plan);
  RenderStats& stats = rendered.stats;
  stats.phases["load"] = load_seconds;

  rendered.image.metadata["photonproof:command"] = command_line(arguments, rendered);
  const Timer write_timer;
  write_image(arguments.output, rendered.image, arguments.exposure.value_or(0));
  stats.phases["write"] = write_timer.seconds();
  const nlohmann::ordered_json json = stats_json(arguments, rendered);
  write_file_atomically(stats_path, json_text(json) + "\n");
  if (!stats.interrupted && (arguments.checkpoint_seconds > 0 || arguments.resume)) remove_checkpoint(checkpoint);
  if (arguments.json)
    std::printf("%s\n", json_text(json).c_str());
  else
    print_summary(arguments, rendered, timer.seconds());
  return outcome(arguments, rendered, checkpoint);
}

}  // namespace

int run_render(const RenderArguments& arguments) {
  return arguments.plan ? print_plan(arguments) : render_to_files(arguments);
}

}  // namespace photonproof::inline harness_verbs_render
