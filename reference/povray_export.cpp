#include "reference/povray_export.h"

#include "reference/povray_camera.h"
#include "reference/povray_geometry.h"
#include "reference/povray_header.h"
#include "reference/povray_lights.h"
#include "reference/povray_materials.h"

namespace photonproof {

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
  write_lights(scene, plan, options.seed, out);
  write_surfaces(scene, plan, out);

  result.sdl = out.text();
  result.grid = plan.preset.grid;
  result.exposure = plan.exposure;
  result.explanations = out.explanations();
  result.skipped = plan.skipped;
  result.losses = plan.losses;
  return result;
}

}  // namespace photonproof
