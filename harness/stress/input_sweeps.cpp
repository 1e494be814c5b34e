#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"
#include "scenes/files/atomic_file.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> no_numbers{"nan", "inf", "-inf", "1e400", "-1e400", "0x1p3"};
constexpr std::array<const char*, 6> extreme_numbers{"1e39", "1e308", "1e-39", "1e-50", "1e-308", "1e-320"};

template <std::size_t n>
Sweep number_in(const char* where, const SceneDescription& scene, const char* marker, const char* measure,
                const std::array<const char*, n>& numbers) {
  Sweep sweep{"input", where, measure, {}, -1, [=](double k) {
                StressScene level{scene};
                level.replaced = marker;
                level.replacement = numbers[static_cast<std::size_t>(k)];
                return level;
              }};
  for (std::size_t i = 0; i < n; ++i) sweep.heights.push_back(static_cast<double>(i));
  sweep.engines = {"path", "photonmapper"};
  return sweep;
}

/// The text of the scene has `marker` in place of the number.
void add_numbers(std::vector<Sweep>& sweeps, const std::string& where, const SceneDescription& scene,
                 const char* marker) {
  sweeps.push_back(number_in(("no number as " + where).c_str(), scene, marker,
                             "k-th of nan, inf, -inf, 1e400, -1e400, 0x1p3", no_numbers));
  sweeps.back().must_refuse = true;
  sweeps.back().goes_on = true;
  sweeps.push_back(number_in(("extreme as " + where).c_str(), scene, marker,
                             "k-th of 1e39, 1e308, 1e-39, 1e-50, 1e-308, 1e-320: a finite image, or an error",
                             extreme_numbers));
  sweeps.back().goes_on = true;
}

using MeshText = std::string (*)(const std::string& number);

/// The floor with one number of a corner's place.
std::string floor_as_ply(const std::string& number) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n-8 0 8\n8 0 8\n8 " +
         number + " -8\n-8 0 -8\n3 0 1 2\n3 0 2 3\n";
}

std::string floor_as_obj(const std::string& number) {
  return "v -8 0 8\nv 8 0 8\nv 8 " + number + " -8\nv -8 0 -8\nf 1 2 3\nf 1 3 4\n";
}

/// The file of the k-th number.
template <std::size_t n>
Sweep number_in_mesh(const fs::path& assets, const char* sweep_run, const char* extension, MeshText text,
                     const char* measure, const std::array<const char*, n>& numbers) {
  const auto file = [=](double k) {
    return fs::absolute(assets / (sweep_run + std::string("-") + std::to_string(static_cast<int>(k)) + extension))
        .string();
  };
  for (std::size_t i = 0; i < n; ++i) write_file_atomically(file(static_cast<double>(i)), text(numbers[i]));
  Sweep sweep{"input", sweep_run, measure, {}, -1, [=](double k) {
                SceneDescription scene = lit_stress_scene();
                MeshDescription floor;
                floor.filename = file(k);
                floor.face_normals = true;
                scene.shapes[0].geometry = floor;
                scene.shapes[0].to_world = Transform();
                return StressScene{scene};
              }};
  for (std::size_t i = 0; i < n; ++i) sweep.heights.push_back(static_cast<double>(i));
  sweep.engines = {"path", "photonmapper"};
  sweep.goes_on = true;
  return sweep;
}

void add_numbers_in_meshes(const fs::path& assets, std::vector<Sweep>& sweeps) {
  constexpr std::array<const char*, 5> none{"nan", "inf", "-inf", "1e400", "-1e400"};
  const auto add = [&](const char* extension, MeshText text, const std::string& kind) {
    sweeps.push_back(number_in_mesh(assets, ("no number in " + kind).c_str(), extension, text,
                                    "k-th of nan, inf, -inf, 1e400, -1e400", none));
    sweeps.back().must_refuse = true;
    sweeps.push_back(number_in_mesh(assets, ("extreme in " + kind).c_str(), extension, text,
                                    "k-th of 1e39, 1e308, 1e-39, 1e-50, 1e-308, 1e-320: a finite image, or an error",
                                    extreme_numbers));
  };
  add(".ply", floor_as_ply, "PLY");
  add(".obj", floor_as_obj, "OBJ");
}

/// One value of the file from which a texture or a sky is read.
Sweep no_number_in_picture(const fs::path& assets, const char* sweep_run,
                           const std::function<SceneDescription(const std::string&)>& scene_of) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  constexpr std::array<float, 4> values{std::numeric_limits<float>::quiet_NaN(), infinite, -infinite, -1e-3f};
  const auto file = [=](double k) {
    return fs::absolute(assets / (std::string(sweep_run) + std::to_string(static_cast<int>(k)) + ".exr")).string();
  };
  Sweep sweep{"input", sweep_run, "k-th of nan, inf, -inf, -0.001",
              {},      -1,        [=](double k) {
                  return StressScene{scene_of(file(k))}; }};
  for (std::size_t i = 0; i < values.size(); ++i) {
    Rendering picture;
    picture.mean = Image(16, 8);
    std::fill(picture.mean.rgb.begin(), picture.mean.rgb.end(), 0.5f);
    picture.mean.pixel(11, 5)[1] = values[i];
    write_exr(file(static_cast<double>(i)), picture);
    sweep.heights.push_back(static_cast<double>(i));
  }
  sweep.engines = {"path", "photonmapper"};
  sweep.must_refuse = true;
  sweep.goes_on = true;
  return sweep;
}

SceneDescription painted_with(const std::string& file) {
  SceneDescription scene = lit_stress_scene();
  BitmapDescription bitmap;
  bitmap.filename = file;
  scene.textures.push_back({{}, "bitmap", bitmap});
  std::get<DiffuseDescription>(scene.bsdfs[0].model).reflectance = TextureIndex{0};
  return scene;
}

SceneDescription under_the_sky_of(const std::string& file) {
  EnvmapDescription sky;
  sky.filename = file;
  return stress_scene_under(sky);
}

}  // namespace

std::vector<Sweep> input_sweeps(const std::filesystem::path& assets) {
  const SceneDescription light = stress_scene_under(PointLightDescription{{1, 5, -1}, RgbD(0.123456789)});
  SceneDescription place = lit_stress_scene();
  add_shape(place, SphereDescription{}, standing({0, 0.123456789, 0}, 1), {0});
  SceneDescription radius = lit_stress_scene();
  add_shape(radius, SphereDescription{{0, 1, 0}, 0.123456789}, Transform(), {0});
  DielectricDescription ior;
  ior.int_ior = 1.23456789;
  const SceneDescription glass = stress_scene_with_bsdf(ior);
  const SceneDescription rough = stress_scene_with_bsdf(of_roughness<RoughConductorDescription>(0.123456789));
  std::vector<Sweep> sweeps;
  add_numbers(sweeps, "intensity", light, "0.123456789");
  add_numbers(sweeps, "place", place, "0.123456789");
  add_numbers(sweeps, "radius", radius, "0.123456789");
  add_numbers(sweeps, "ior", glass, "1.23456789");
  add_numbers(sweeps, "roughness", rough, "0.123456789");
  add_numbers_in_meshes(assets, sweeps);
  sweeps.push_back(no_number_in_picture(assets, "no number in a texture", painted_with));
  sweeps.push_back(no_number_in_picture(assets, "no number in a sky", under_the_sky_of));
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
