#include "reference/povray_export.h"

#include <algorithm>
#include <fstream>

#include "reference/povray_camera.h"
#include "reference/povray_geometry.h"
#include "reference/povray_header.h"
#include "reference/povray_lights.h"
#include "reference/povray_materials.h"
#include "scenes/atomic_file.h"

namespace photonproof {
namespace {

/// POV-Ray's command-line words for where a pixel is sampled.
std::vector<std::string> antialias(const PovrayOptions& options) {
  if (options.grid > 0) return {"-A"};  // one ray through the centre of each of grid x grid sub-pixels
  // Corners first, and wherever they differ by a tenth (of a gamma-encoded channel) a finer grid, at most 16 x 16
  // cells: the trapezoidal rule over the pixel, in linear light and without clipping.
  return {"+AM2", "+A0.1", "+R5", "-J"};
}

/// What radiosity's rays see instead of the surfaces above. A ray of theirs is one of hundreds, so its shadow rays need
/// not find every part of a light: lighting them with fewer points halves the time at equal error.
void write_radiosity_group(const PovScene& scene, const PovPlan& plan, std::uint64_t seed, SdlWriter& out) {
  if (!plan.radiosity || !plan.point_lights) return;
  out.explain("twins of the diffuse surfaces, in the same places, for radiosity's rays only: lit by fewer points, and");
  out.explain("without the light that light_sources stand for, lest it count twice");
  out.line("light_group{");
  write_lights(scene, plan, plan.preset.radiosity_points, ~seed, out);
  write_twins(scene, plan, out);
  out.line("global_lights off}");
}

}  // namespace

void write_sdl(const PovrayExport& scene, const std::filesystem::path& target) {
  replace_atomically(target, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    scene.sdl.write(out);
    out.close();
    if (!out) throw InputError(target.string(), "cannot be written (permission or disk full)");
  });
}

PovrayExport export_povray(const SceneDescription& description, const PovrayOptions& options) {
  PovrayExport result;
  result.width = options.width > 0 ? options.width : description.sensor.film.width;
  result.height = options.height > 0 ? options.height : description.sensor.film.height;
  PovScene scene = lower_scene(description);
  const PovPlan plan = make_plan(scene, options);
  const PovCamera camera = lower_camera(description, result.width, result.height);
  apply_clip_planes(camera, scene);

  SdlWriter out;
  write_header(scene, plan, out);
  out.explain(
      "camera of " + description.where(description.sensor.loc) +
      ": direction, right and up as they are, so that the picture is not mirrored in POV-Ray's left-handed axes");
  out.line(camera_sdl(camera, plan.scale));
  write_materials(scene, out);
  if (plan.point_lights) {
    write_spot_macro(plan, out);
    write_lights(scene, plan, plan.photons ? plan.preset.photon_points : plan.preset.image_points, options.seed, out);
  }
  write_surfaces(scene, plan, out);
  write_radiosity_group(scene, plan, options.seed, out);

  result.sdl = out.text();
  result.grid = std::max(1, options.grid);
  result.antialias = antialias(options);
  result.exposure = plan.exposure;
  result.explanations = out.explanations();
  result.skipped = plan.skipped;
  result.losses = plan.losses;
  return result;
}

}  // namespace photonproof
