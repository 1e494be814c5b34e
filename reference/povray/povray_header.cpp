#include "reference/povray/povray_header.h"

#include <algorithm>
#include <cmath>

#include "reference/povray/povray_paths.h"
#include "reference/povray/povray_pigments.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline reference_povray {
namespace {

/// POV-Ray measures reuse by the distance to the camera; the scene's own size sets the necessary distance.
double reuse_by_camera_distance(const PovScene& scene, double by_scene_radius) {
  const Vec3d eye = scene.description->sensor.to_world.point({0, 0, 0});
  // From inside, visible surfaces are about as far away as the walls of a cube inscribed in the sphere.
  const double distance = std::max(length(eye - scene.center), scene.radius / std::sqrt(3.0));
  return by_scene_radius * scene.radius / distance;
}

std::string radiosity_sdl(const PovScene& scene, const PovPlan& plan) {
  if (plan.paths) return path_radiosity_sdl(plan);
  const PovrayPreset& preset = plan.preset;
  const double maximum_reuse = reuse_by_camera_distance(scene, preset.maximum_reuse);
  return "  radiosity{count " + std::to_string(preset.radiosity_count) + ",20000 nearest_count " +
         std::to_string(preset.nearest_count) + " error_bound " + format_number(preset.error_bound) +
         " low_error_factor " + format_number(preset.low_error_factor) + " recursion_limit " +
         std::to_string(plan.recursion_limit) + " gray_threshold 0 brightness Brightness adc_bailout " +
         format_number(preset.radiosity_bailout) + " minimum_reuse " + format_number(maximum_reuse / 3) +
         " maximum_reuse " + format_number(maximum_reuse) + " pretrace_start 0.08 pretrace_end " +
         format_number(preset.pretrace_end) + " normal off media off}";
}

/// Upper bound on the photons of one gather, which must never be reached. POV-Ray allocates room for that many each
/// time; large blocks come from the kernel, which took two fifths of the time of paths.
std::string most_photons(const PovPlan& plan) { return plan.paths ? "2000" : "20000"; }

std::string photons_sdl(const PovScene& scene, const PovPlan& plan) {
  return "  photons{count " + std::to_string(plan.preset.photons) + " radius " +
         format_number(plan.preset.photon_radius * scene.radius * plan.scale) + " gather 1," + most_photons(plan) +
         " expand_thresholds 0,0 autostop 0 jitter 1 max_trace_level 12 adc_bailout 1e-4}";
}

}  // namespace

void write_header(const PovScene& scene, const PovPlan& plan, SdlWriter& out) {
  const auto& files = scene.description->files;
  out.explain("exported by photonproof from " + (files.empty() ? std::string("a scene") : files.front()) +
              "; render with: povray +FE -A +WT1");
  out.explain("lengths are the scene's times " + rounded(plan.scale) +
              ", far above POV-Ray's absolute tolerances of 1e-3 and 1e-4");
  out.explain("radiances are the scene's times " + rounded(plan.exposure) + ", near 1, where half floats are precise");
  for (const std::string& text : plan.skipped) out.explain("skipped " + text);
  for (const std::string& text : plan.losses) out.explain("loss: " + text);
  out.line("#version 3.7;");
  if (plan.radiosity)
    out.explain(
        "Brightness leaves radiances as they are and has POV-Ray's radiosity take every bounce for as important");
  out.line("#declare Brightness = " + format_number(plan.brightness) + ";");
  out.explain(
      "light that is reflected totally, in facets of glass, leaves after dozens of bounces: adc_bailout ends rays");
  out.line("global_settings{assumed_gamma 1.0 max_trace_level 100 adc_bailout 1e-5");
  if (plan.radiosity) out.line(radiosity_sdl(scene, plan));
  if (plan.photons) out.line(photons_sdl(scene, plan));
  out.line("}");
  if (scene.sky && plan.shows_sky)
    out.explain("light from all around, of " + scene.description->where(scene.sky->loc) +
                (scene.sky_as_lights ? ": a ball far away, which is only seen; it lights by parallel lights"
                                     : ": what rays see where nothing is; radiosity's rays find it"));
  out.line(plan.shows_sky ? sky_sdl(scene, plan.exposure, plan.scale, plan.stem) : "background{rgb 0}");
  out.line("#default{finish{ambient 0 diffuse 1/Brightness emission 0}" + (plan.paths ? importance_sdl(plan) : "") +
           "}");
}

}  // namespace photonproof::inline reference_povray
