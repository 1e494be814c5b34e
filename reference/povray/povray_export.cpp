#include "reference/povray/povray_export.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "reference/povray/povray_camera.h"
#include "reference/povray/povray_geometry.h"
#include "reference/povray/povray_header.h"
#include "reference/povray/povray_lights.h"
#include "reference/povray/povray_materials.h"
#include "reference/povray/povray_paths.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reference_povray {
namespace {

/// POV-Ray's command-line words for rays through the centres of pixels alone.
const std::vector<std::string> through_centres{"-A"};

/// POV-Ray's options for rays through pixel corners, refined where corners differ by a tenth (of a gamma-encoded
/// channel) to at most 2^halvings cells across a pixel. This is the trapezoidal rule in linear light, without clipping.
std::vector<std::string> refined(int halvings) { return {"+AM2", "+A0.1", "+R" + std::to_string(halvings), "-J"}; }

bool shows_bright_lights(const PovScene& scene, const PovPlan& plan) {
  return plan.shows_lights && !scene.hides_lights &&
         std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                     [](const PovSurface& surface) { return surface.emission == PovSurface::Emission::spots; });
}

/// Images that show lights need fine cells. The light of `cornell` is 12 pixels wide and 40 times as bright as the
/// mean. An error of 1/32 of a pixel at its edges made the image's mean 0.45 % too high. Many lights at every ray's end
/// make fine cells slow: with coarse ones `many-lights` is as accurate in two fifths of the time.
constexpr int ordinary_halvings = 5, light_halvings = 7, many_lights_halvings = 2;

int halvings(const PovScene& scene, const PovPlan& plan) {
  if (shows_bright_lights(scene, plan)) return light_halvings;
  return plan.point_lights && has_many_lights(scene) ? many_lights_halvings : ordinary_halvings;
}

/// The twins that radiosity's rays see instead of the surfaces above. Radiosity averages hundreds of rays, so their
/// shadow rays need not find every part of a light: fewer points halve the time at equal error.
void write_radiosity_group(const PovScene& scene, const PovPlan& plan, std::uint64_t seed, SdlWriter& out) {
  if (!plan.radiosity || !plan.point_lights) return;
  out.explain("twins of the diffuse surfaces, in the same places, for radiosity's rays only: lit by fewer points, and");
  out.explain("without the light that light_sources stand for, so that it does not count twice");
  out.line("light_group{");
  write_lights(scene, plan, plan.preset.radiosity_points, ~seed, out);
  if (plan.paths) write_fate(seed, out);
  write_twins(scene, plan, out);
  out.line("global_lights off}");
}

}  // namespace

void write_sdl(const PovrayExport& scene, const std::filesystem::path& target) {
  for (const PovFile& file : scene.files)
    write_exr((target.parent_path() / file.name).string(), Rendering{*file.image, {}, {}}, ExrColour::half);
  replace_atomically(target, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    scene.sdl.write(out);
    out.close();
    if (!out) throw InputError(target.string(), "cannot be written (permission or disk full)");
  });
}

namespace {

/// A light thinner than this many pixels may lie between the corners that POV-Ray samples first, which then show no
/// edge to refine. Its visible part is far brighter than the rest of the image.
constexpr double thin_light = 1.5;
constexpr int finest_light_grid = 16;

/// Rays through a lens in every sub-pixel. POV-Ray spreads them over the sub-pixel, too, so no grid is needed without a
/// filter. With 256 rays in each of 4 x 4 sub-pixels `lens` took minutes.
int lens_samples(int grid) { return grid <= 1 ? 256 : 37; }

/// Sub-pixels across a pixel behind a lens where a filter weighs them.
constexpr int lens_filter_grid = 4;

/// Whether facets mirror or refract; they may show something else between two corners that look alike. Without a grid
/// for its light, the image of a glass of 168 facets lacked 4 % of its light.
bool has_facets(const PovScene& scene) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const PovSurface& surface) {
    return is_specular(surface) && std::holds_alternative<PovMesh>(surface.geometry);
  });
}

/// Sub-pixels across a pixel where there are textures or facets.
constexpr int pattern_grid = 4;

bool has_patterns(const PovScene& scene) {
  return has_facets(scene) || std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const PovSurface& surface) {
           const PovSides& sides = surface.sides;
           return (sides.front && is_textured(*scene.description, *sides.front)) ||
                  (sides.back && is_textured(*scene.description, *sides.back)) ||
                  surface.emission == PovSurface::Emission::picture;
         });
}

/// Sub-pixels across a pixel where a filter weighs them.
constexpr int filter_grid = 8;

/// Rows and columns beyond the picture's edge that its filter reaches.
int margin_of(const ReconstructionFilter& filter) {
  switch (filter.kind) {
    case ReconstructionFilter::Kind::box:
      return 0;
    case ReconstructionFilter::Kind::tent:
      return static_cast<int>(std::ceil(filter.radius - 0.5));
    case ReconstructionFilter::Kind::gaussian:
      return static_cast<int>(std::ceil(4 * filter.stddev - 0.5));
    case ReconstructionFilter::Kind::mitchell:
      return static_cast<int>(std::ceil(filter.mitchell_radius.value_or(2) - 0.5));
    case ReconstructionFilter::Kind::catmullrom:
      return 2;
    case ReconstructionFilter::Kind::lanczos:
      return filter.lobes;
    case ReconstructionFilter::Kind::sinc:
      return static_cast<int>(std::ceil(filter.sinc_radius - 0.5));
  }
  return 0;
}

PovrayExport export_scene(const PovScene& scene, const PovPlan& plan, const PovCamera& camera,
                          const PovrayOptions& options) {
  const SceneDescription& description = *scene.description;
  PovrayExport result;
  result.width = options.width;
  result.height = options.height;
  SdlWriter out;
  write_header(scene, plan, out);
  out.explain(
      "camera of " + description.where(description.sensor.loc) +
      ": direction, right and up as they are, so that the picture is not mirrored in POV-Ray's left-handed axes");
  out.line(camera_sdl(camera, plan.scale, lens_samples(options.grid)));
  write_materials(scene, plan, out);
  if (plan.point_lights) {
    write_spot_macro(plan, out);
    write_lights(scene, plan, plan.photons ? plan.preset.photon_points : plan.preset.image_points, options.seed, out);
  }
  write_surfaces(scene, plan, clip_sdl(camera, plan.scale), out);
  write_radiosity_group(scene, plan, options.seed, out);

  result.sdl = out.text();
  result.grid = std::max(1, options.grid);
  const bool centres = options.grid > 0 || camera.kind == PovCamera::Kind::thin_lens;  // of grid x grid sub-pixels
  result.antialias = centres ? through_centres : refined(halvings(scene, plan));
  result.margin = options.margin;
  result.is_noisy = plan.paths;
  result.film = description.sensor.film;
  result.film.resize(options.width, options.height);
  result.files = image_files(scene, plan.exposure, plan.stem);
  result.exposure = plan.exposure;
  result.explanations = out.explanations();
  result.skipped = plan.skipped;
  result.losses = plan.losses;
  return result;
}

/// Only the visible light of light surfaces, seen directly or in mirrors and glass. No surface is lit, so many samples
/// are cheap. Several lines of the sub-pixel grid pass through every light.
PovrayExport export_lights(const PovScene& scene, PovPlan plan, const PovCamera& camera, const PovrayOptions& options,
                           double thinnest) {
  plan.point_lights = plan.radiosity = plan.paths = plan.photons = plan.shows_sky = false;
  plan.brightness = 1;
  PovrayOptions finer = options;
  finer.grid = has_facets(scene) ? finest_light_grid : 0;
  PovrayExport lights = export_scene(scene, plan, camera, finer);
  if (finer.grid > 0) return lights;
  lights.grid = std::clamp(static_cast<int>(std::ceil(2 * thin_light / thinnest)), 2, finest_light_grid);
  // With one halving fewer `caustic-glass` lacks 0.13 % of its light instead of 0.11 %, in a third of the time.
  const bool is_fine = lights.grid >= 8 && camera.kind != PovCamera::Kind::thin_lens;
  if (is_fine) lights.antialias = refined(light_halvings - 1);
  return lights;
}

}  // namespace

PovrayExport export_povray(const SceneDescription& description, const PovrayOptions& given) {
  PovrayOptions options = given;
  if (options.width <= 0) options.width = description.sensor.film.width;
  if (options.height <= 0) options.height = description.sensor.film.height;
  options.margin = margin_of(description.sensor.film.filter);
  PovScene scene = lower_scene(description);
  const bool lens = std::holds_alternative<ThinLensDescription>(description.sensor.camera);
  if (options.grid == 0 && options.margin > 0) options.grid = lens ? lens_filter_grid : filter_grid;
  if (options.grid == 0 && has_patterns(scene) && !lens) options.grid = pattern_grid;
  PovPlan plan = make_plan(scene, options);
  if (plan.paths && options.grid == 0)
    options.grid = plan.photons ? plan.preset.paths->photon_grid : plan.preset.paths->grid;
  const PovCamera camera = lower_camera(description, options.width, options.height, options.margin, "POV-Ray");
  apply_clip_planes(camera, scene);
  const double thinnest = thinnest_light(camera, scene, options.width, options.height);
  // Paths' variance would count the edge of a light as noise. Photon noise needs no refinement as fine as lights do:
  // `cornell-spheres` takes 14 s with its lights apart, 23 s without.
  const bool apart = thinnest <= thin_light || ((plan.paths || plan.photons) && shows_bright_lights(scene, plan));
  plan.shows_lights = !options.lights_apart || given.grid > 0 || !apart;
  PovCamera seen = camera;
  if (plan.paths && options.grid > 1)
    seen = with_moved_grid(camera, (options.width + 2 * options.margin) * options.grid,
                           (options.height + 2 * options.margin) * options.grid, options.seed);
  PovrayExport result = export_scene(scene, plan, seen, options);
  if (plan.shows_lights) return result;
  plan.shows_lights = true;
  result.besides.push_back(export_lights(scene, plan, camera, options, thinnest));
  return result;
}

}  // namespace photonproof::inline reference_povray
