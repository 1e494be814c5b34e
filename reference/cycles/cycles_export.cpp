#include "reference/cycles/cycles_export.h"

#include <algorithm>
#include <numbers>
#include <thread>
#include <variant>

#include "blender_facets_text.h"
#include "blender_lights_text.h"
#include "blender_scene_text.h"
#include "blender_shaders_text.h"
#include "blender_shapes_text.h"
#include "reference/cycles/cycles_lights.h"
#include "reference/cycles/cycles_shaders.h"
#include "reference/cycles/cycles_shapes.h"
#include "reference/cycles/python_text.h"
#include "reference/engines/lowered_camera.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/emitter_kinds.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reference_cycles {
namespace {

constexpr int most_bounces = 1024;  // that Cycles takes

/// Cycles counts bounces after the first surface that light meets: 0 bounces are direct light, a path of two edges.
int bounces_of(const CyclesScript& script) {
  const SceneDescription& scene = script.scene();
  const int depth = scene.integrator.limits().max_depth;
  if (depth < 0) return most_bounces;
  const SourceLoc& loc = scene.integrator.loc;
  if (depth == 1) script.refuse(loc, "max_depth 1: Cycles has no end of paths before direct light");
  const auto pane = [&](const ShapeDescription& shape) { return traits_of(scene, shape.bsdf).pane; };
  if (std::any_of(scene.shapes.begin(), scene.shapes.end(), pane))
    script.refuse(loc, "max_depth with a thin dielectric: Cycles does not count what passes it as part of a path");
  return std::min(depth - 2, most_bounces);
}

/// Cycles' paths start at the camera. They never find light of a light without size that mirrors or glass cast onto
/// rough surfaces or into fog.
void check_lights(const CyclesScript& script) {
  const SceneDescription& scene = script.scene();
  bool clear = false, chance = false, wide = !scene.media.empty();
  const auto look_at = [&](const ShapeDescription& shape) {
    if (std::holds_alternative<InstanceDescription>(shape.geometry)) return;
    const CyclesTraits traits = traits_of(scene, shape.bsdf);
    clear |= traits.clear;
    chance |= traits.chance;
    wide |= traits.wide;
  };
  std::for_each(scene.shapes.begin(), scene.shapes.end(), look_at);
  for (const ShapeGroupDescription& group : scene.groups)
    std::for_each(group.shapes.begin(), group.shapes.end(), look_at);
  for (const EmitterDescription& emitter : scene.emitters) {
    const bool small = is_without_size(emitter);
    if (small && chance)
      script.refuse(emitter.loc,
                    "a light without size beside rough metal with an index, rough glass, plastic or phong: Cycles has "
                    "no such lobes and meets lights by chance only");
    if (small && clear && wide)
      script.refuse(emitter.loc,
                    "a light without size beside mirrors or glass: its caustics can be sampled from the light only, "
                    "and Cycles' paths start at the camera");
  }
}

/// Cycles' name of the filter and its width in pixels.
std::string filter_py(CyclesScript& script) {
  const SceneDescription& scene = script.scene();
  const ReconstructionFilter& filter = scene.sensor.film.filter;
  switch (filter.kind) {
    case ReconstructionFilter::Kind::box:
      return "\"BOX\", 1";
    case ReconstructionFilter::Kind::gaussian:
      // Cycles' filter is exp(-2 (6 x / w)^2) with w three times the width: a Gaussian of deviation width / 4, cut at 6
      // deviations. Ours is cut at 4 and lowered by exp(-8) = 3e-4.
      if (4 * filter.stddev > 10)
        script.refuse(scene.sensor.loc, "a Gaussian filter of a deviation above 2.5 pixels: Cycles has none so wide");
      if (!scene.sensor.film.sample_border)
        script.explain("pixels at the border: Cycles' filter sees beyond the film there, the scene's does not");
      return "\"GAUSSIAN\", " + format_number(4 * filter.stddev);
    case ReconstructionFilter::Kind::tent:
      script.refuse(scene.sensor.loc, "a tent filter: Cycles has none; a box or a Gaussian can be written");
    default:
      script.refuse(scene.sensor.loc,
                    "a filter with negative lobes: Cycles has none; a box or a Gaussian can be written");
  }
}

std::string camera_py(const LoweredCamera& camera) {
  const char* kind = camera.kind == LoweredCamera::Kind::fisheye        ? "fisheye"
                     : camera.kind == LoweredCamera::Kind::orthographic ? "orthographic"
                                                                        : "perspective";
  const auto number = [](double value) { return format_number(value); };
  std::string text = "camera(" + py_string(kind) + ", (" + py_tuple(camera.right) + ", " + py_tuple(camera.up) + ", " +
                     py_tuple(-camera.forward) + ", " + py_tuple(camera.origin) + "), " + number(camera.near_clip) +
                     ", " + number(camera.far_clip);
  if (camera.kind == LoweredCamera::Kind::fisheye) return text + ", angle=" + number(camera.angle) + ")";
  text += ", (" + number(camera.tan_x) + ", " + number(camera.tan_y) + ")";
  if (camera.middle_x != 0 || camera.middle_y != 0)
    text += ", (" + number(camera.middle_x) + ", " + number(camera.middle_y) + ")";
  if (camera.kind == LoweredCamera::Kind::thin_lens)
    text += ", lens_radius=" + number(camera.lens_radius) + ", focus=" + number(camera.focus_distance);
  return text + ")";
}

std::string render_py(const std::vector<EngineBatch>& batches) {
  std::string text = "render((";
  for (const EngineBatch& batch : batches)
    text += "(" + std::to_string(batch.samples) + ", " + std::to_string(batch.seed) + "), ";
  return text + "))";
}

}  // namespace

CyclesExport export_cycles(const SceneDescription& scene, const CyclesOptions& options) {
  CyclesExport result;
  result.width = options.width > 0 ? options.width : scene.sensor.film.width;
  result.height = options.height > 0 ? options.height : scene.sensor.film.height;
  result.film = scene.sensor.film;
  result.film.resize(result.width, result.height);
  result.samples = options.samples > 0 ? options.samples : scene.sensor.sample_count;
  result.threads =
      options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  result.batches = engine_batches(result.samples, options.seed);

  CyclesScript script(scene, options.stem);
  check_lights(script);
  script.line("clear()");
  script.line("settings(" + std::to_string(result.width) + ", " + std::to_string(result.height) + ", " +
              std::to_string(result.threads) + ", " + std::to_string(bounces_of(script)) + ", " + filter_py(script) +
              ")");
  script.explain("camera of " + scene.where(scene.sensor.loc) + ": Blender's looks along -z, its +x to the right");
  script.line(camera_py(lower_camera(scene, result.width, result.height, 0, "Cycles")));
  write_shapes(script);
  write_lights(script);
  script.line(render_py(result.batches));

  result.text = script.text();
  result.files = script.files();
  result.explanations = script.explanations();
  return result;
}

std::string whole_script(const CyclesExport& scene) {
  std::string text;
  for (const char* part :
       {blender_scene_text, blender_shapes_text, blender_shaders_text, blender_facets_text, blender_lights_text})
    text += std::string(part) + "\n\n";
  return text + "# The scene\n\n" + scene.text;
}

void write_script(const CyclesExport& scene, const std::filesystem::path& target) {
  for (const CyclesFile& file : scene.files) write_cycles_file(file, target.parent_path());
  write_file_atomically(target, whole_script(scene));
}

}  // namespace photonproof::inline reference_cycles
