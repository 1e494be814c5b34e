#include "reference/povray/povray_paths.h"

#include <array>
#include <random>
#include <variant>

#include "reference/povray/povray_materials.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline reference_povray {
namespace {

/// Edge of a cell, in POV-Ray's lengths, where the scene's radius is about 64; and of the cells within a cell. Odd
/// numbers, so that neither lie along walls.
constexpr double kCell = 0.0371, kInnerCell = 0.00863;

/// Radius of a ball around everything, in POV-Ray's lengths; squares for endless planes end before.
constexpr double kAround = 1e6;

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Whether a side is plainly diffuse; a missing back counts as a black one.
bool is_plainly_diffuse(const BsdfDescription* side) {
  return side == nullptr || std::holds_alternative<DiffuseDescription>(side->model);
}

}  // namespace

std::string path_radiosity_sdl(const PovPlan& plan) {
  const PovrayPaths& paths = *plan.preset.paths;
  return "  radiosity{count " + std::to_string(paths.count) + "," + std::to_string(paths.directions) +
         " nearest_count 1 error_bound 1e-6 recursion_limit " + std::to_string(plan.recursion_limit) +
         " gray_threshold 0 brightness Brightness adc_bailout " + format_number(plan.preset.radiosity_bailout) +
         " minimum_reuse 1e-9 maximum_reuse 1e12 pretrace_start 1 pretrace_end 1 normal off media off}";
}

std::string importance_sdl(const PovPlan& plan) {
  return " radiosity{importance " + format_number(plan.preset.paths->importance) + "}";
}

PovCamera with_moved_grid(PovCamera camera, int across, int down, std::uint64_t seed) {
  if (camera.kind != PovCamera::Kind::perspective) return camera;
  std::mt19937_64 random(~seed);  // other numbers than the fate's
  const auto within_one = [&](int count) { return (2 * uniform(random) - 1) / count; };  // a sub-pixel is 2 / count
  camera.middle_x += within_one(across);
  camera.middle_y += within_one(down);
  return camera;
}

void write_fate(std::uint64_t seed, SdlWriter& out) {
  out.explain(
      "a black ball around everything, so that every ray of radiosity's meets something: else its cache is used");
  out.line("sphere{0, " + format_number(kAround) +
           " inverse texture{Black} no_image no_shadow no_reflection photons{collect off}}");
  std::mt19937_64 random(seed);
  std::array<double, 3> shift{};
  for (double& s : shift) s = uniform(random);
  out.explain("a quarter of every twin is black, in tiny cells, and the rest 4/3 as bright: there paths end by chance");
  out.line("#declare Fate = pigment{checker pigment{checker rgb 0 rgb 1 scale " + format_number(kInnerCell / kCell) +
           "} pigment{rgb 1} scale " + format_number(kCell) + " translate <" + format_number(shift[0]) + "," +
           format_number(shift[1]) + "," + format_number(shift[2]) + ">}");
}

std::string mortal_material_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan) {
  const PovSides& sides = surface.sides;
  const bool plain = sides.front && sides.opacity >= 1 && !surface.absorption && is_plainly_diffuse(sides.front) &&
                     is_plainly_diffuse(sides.back);
  if (!plain) return material_of(scene, surface, plan);
  // One texture of two, and no blend: a value beyond the last entry has that alone.
  const auto mortal = [&](const BsdfDescription& side) {
    return "texture{pigment_pattern{Fate} texture_map{[0.5 Black][0.5 " + placed_texture(scene, surface, side, plan) +
           " finish{ambient 0 diffuse 4/3/Brightness emission 0}]}}";
  };
  const bool has_back = sides.back && !surface.clear_back;
  return " " + mortal(*sides.front) + (has_back ? " interior_" + mortal(*sides.back) : back_of(scene, surface, plan));
}

}  // namespace photonproof::inline reference_povray
