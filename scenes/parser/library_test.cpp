// The numbers of the scene library compared with their sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <numbers>

#include "scenes/description/expect.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/generators/library_assets.h"
#include "scenes/generators/many_lights.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_parser {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

const std::string kLibrary = std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/library/";

SceneDescription load(const std::string& name) { return parse_scene_file(kLibrary + name + "/scene.xml"); }

const PerspectiveDescription& camera_of(const SceneDescription& scene) {
  return std::get<PerspectiveDescription>(scene.sensor.camera);
}

TEST(library, scenes_take_a_size_and_say_what_is_expected_of_them) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(kLibrary)) {
    const std::string path = (entry.path() / "scene.xml").string();
    const FilmDescription film = parse_scene_file(path, {{{"size", "33"}}, false}).sensor.film;
    EXPECT_EQ(film.width, 33) << path;
    EXPECT_EQ(film.height, 33) << path;
    const Expect expect = read_expect(expect_path_of(path));
    EXPECT_EQ(expect.purpose.back(), '.') << path;
    EXPECT_FALSE(expect.analytic && expect.analytic->formula.empty()) << path;
    ++scenes;
  }
  EXPECT_GE(scenes, 55);
}

TEST(library, has_every_scene_that_is_asked_for) {
  for (const char* name : {"cornell", "cornell-spheres", "caustic-glass", "course-1", "course-2", "course-3", "pool",
                           "furnace", "corridor", "keyhole", "roughness", "fog", "milk", "whitted", "lens", "fisheye",
                           "daylight", "many-lights", "million"})
    EXPECT_TRUE(fs::exists(kLibrary + name + "/scene.xml")) << name;
  for (const char* bsdf :
       {"conductor", "roughconductor", "dielectric", "thindielectric", "roughdielectric", "plastic", "roughplastic",
        "phong", "layered", "twosided", "mask", "blendbsdf", "null", "bumpmap", "normalmap"})
    EXPECT_TRUE(fs::exists(kLibrary + "furnace-" + bsdf + "/scene.xml")) << bsdf;
  for (const char* light : {"area", "sphere", "disk", "cylinder", "mesh", "point", "spot", "directional", "constant",
                            "envmap", "ies", "sunsky"})
    EXPECT_TRUE(fs::exists(kLibrary + "light-" + light + "/scene.xml")) << light;
}

TEST(library, assets_are_what_the_program_generates) {
  const ScratchFolder folder("library-test");
  for (const LibraryAsset& asset : library_assets()) {
    const fs::path made = folder.path() / fs::path(asset.path).filename(), kept = kLibrary + asset.path;
    asset.write(made);
    EXPECT_LT(fs::file_size(kept), 100'000u) << asset.path;
    if (!asset.image) {
      EXPECT_EQ(read_file(made), read_file(kept)) << asset.path;
      continue;
    }
    // The maths library may round another way, which a byte of a PNG or the last bits of a float may show.
    const Image a = read_image(made.string()), b = read_image(kept.string());
    ASSERT_EQ(a.rgb.size(), b.rgb.size()) << asset.path;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) ASSERT_NEAR(a.rgb[i], b.rgb[i], 0.01f) << asset.path << " " << i;
  }
}

TEST(library, many_lights_is_what_the_program_generates) {
  EXPECT_EQ(read_file(kLibrary + "many-lights/scene.xml"), many_lights_scene(1000));
  const std::string expected = many_lights_expect(1000);  // before what is measured of this one
  EXPECT_EQ(read_file(kLibrary + "many-lights/expect.toml").substr(0, expected.size()), expected);
  const auto scene = load("many-lights");
  EXPECT_EQ(
      std::count_if(scene.shapes.begin(), scene.shapes.end(), [](const auto& s) { return s.radiance.has_value(); }),
      1000);
}

TEST(library, course_water_is_the_assignments) {
  for (const auto& [name, height] : {std::pair{"course-2", 22.0}, {"course-3", -22.0}}) {
    const auto scene = load(name);
    const ShapeDescription& water = scene.shapes.back();
    const auto& field = std::get<HeightfieldDescription>(water.geometry);
    EXPECT_EQ(field.columns, 499);
    EXPECT_EQ(field.rows, 499);
    EXPECT_NEAR(water.to_world.point({0, 0, 0}).y, height, 1e-12);
    EXPECT_NEAR(water.to_world.vector({0, 0, field.amplitude}).y, 1, 1e-12) << "displaced by +-1";
    // 0.14 lattice cells a unit of (x / 1.2, z).
    const auto& noise = std::get<HeightfieldDescription::Noise>(field.height);
    EXPECT_NEAR(noise.frequency_x / length(water.to_world.vector({1, 0, 0})), 0.14 / 1.2, 1e-12);
    EXPECT_NEAR(noise.frequency_y / length(water.to_world.vector({0, 1, 0})), 0.14, 1e-12);
    EXPECT_EQ(std::get<DielectricDescription>(scene.bsdfs.at(water.bsdf.value).model).int_ior, 1.3);
    EXPECT_EQ(camera_of(scene), camera_of(load("course-1")));
  }
}

TEST(library, rectangles_of_the_boxes_face_into_them) {
  for (const char* name : {"cornell", "cornell-spheres", "caustic-glass", "course-1"}) {
    int rectangles = 0;
    for (const ShapeDescription& shape : load(name).shapes) {
      if (!std::holds_alternative<RectangleDescription>(shape.geometry)) continue;
      const Vec3d center = shape.to_world.point({0, 0, 0});
      const Vec3d normal = shape.to_world.vector({0, 0, shape.flip_normals ? -1.0 : 1.0});
      EXPECT_GT(shape.to_world.determinant(), 0) << "a mirroring transform would turn the normal";
      EXPECT_LT(dot(normal, center), 0) << name << ": every box is centred on the origin";
      ++rectangles;
    }
    // Five walls and a light; course-1 has the front wall too.
    EXPECT_EQ(rectangles, std::string(name) == "course-1" ? 7 : 6) << name;
  }
}

/// Full side lengths of a rectangle in the world.
Vec2<double> sides(const ShapeDescription& shape) {
  return {2 * length(shape.to_world.vector({1, 0, 0})), 2 * length(shape.to_world.vector({0, 1, 0}))};
}

const ShapeDescription& light_of(const SceneDescription& scene) {
  for (const ShapeDescription& shape : scene.shapes)
    if (shape.radiance) return shape;
  throw std::logic_error("no light");
}

TEST(library, cornell_spheres_and_caustic_glass_differ_in_light_and_mirror_only) {
  const auto spheres = load("cornell-spheres"), caustic = load("caustic-glass");
  EXPECT_EQ(sides(light_of(spheres)), (Vec2<double>{0.47, 0.38}));
  EXPECT_EQ(sides(light_of(caustic)), (Vec2<double>{0.047, 0.038}));
  EXPECT_EQ(constant(*light_of(spheres).radiance), RgbD(17, 12, 4));
  EXPECT_EQ(constant(*light_of(caustic).radiance), RgbD(1700, 1200, 400));
  EXPECT_EQ(light_of(spheres).to_world.point({0, 0, 0}), Vec3d(0, 0.998, 0));
  EXPECT_EQ(camera_of(spheres), camera_of(caustic));
  EXPECT_EQ(std::get<PathDescription>(spheres.integrator.method).max_depth, 17);
  EXPECT_EQ(std::get<PathDescription>(caustic.integrator.method).max_depth, 17);
  EXPECT_EQ(spheres.shapes.size(), caustic.shapes.size() + 1);
}

TEST(library, course_1_has_the_assignments_camera_and_light) {
  const auto scene = load("course-1");
  // The image plane at z = 49.9, 100.1 before the camera at z = 150, spans -49.5 to 49.5.
  EXPECT_DOUBLE_EQ(camera_of(scene).fov_degrees, 2 * std::atan(49.5 / 100.1) * 180 / pi);
  EXPECT_EQ(camera_of(scene).near_clip, 100.1);
  EXPECT_EQ(scene.sensor.to_world.point({0, 0, 0}), Vec3d(0, 0, 150));
  // Flux of a Lambertian square: pi * area * radiance = 15000 a channel.
  const auto light = light_of(scene);
  EXPECT_NEAR(pi * sides(light).x * sides(light).y * constant(*light.radiance).x, 15000, 1e-9);
}

TEST(library, furnace_emits_inward_and_its_mean_is_the_geometric_series) {
  const auto scene = load("furnace");
  const ShapeDescription& sphere = scene.shapes.at(0);
  EXPECT_TRUE(sphere.flip_normals);
  const double albedo = constant(std::get<DiffuseDescription>(scene.bsdfs.at(sphere.bsdf.value).model).reflectance).x;
  const RgbD mean = *read_expect(kLibrary + "furnace/expect.toml").analytic->mean;
  EXPECT_DOUBLE_EQ(mean.x, constant(*sphere.radiance).x / (1 - albedo));
}

/// The mean over the image plane of a radiance given on the plane y = 0, by the midpoint rule on 512 x 512 points. The
/// error falls as the square of the step; from 256 x 256 points on the mean changes by 2e-6 relative in these scenes.
double image_mean(const SceneDescription& scene, const std::function<double(double, double)>& radiance_at_xz) {
  constexpr int kSteps = 512;
  EXPECT_EQ(camera_of(scene).fov_axis, FovAxis::x);
  const double half = std::tan(camera_of(scene).fov_degrees / 2 * pi / 180);
  const Vec3d eye = scene.sensor.to_world.point({0, 0, 0});
  double sum = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const Vec3d local{half * (2 * (i + 0.5) / kSteps - 1), half * (2 * (j + 0.5) / kSteps - 1), 1};
      const Vec3d ray = scene.sensor.to_world.vector(local);
      const double t = -eye.y / ray.y;
      EXPECT_GT(t, 0) << "the view must be filled by the plane";
      sum += radiance_at_xz(eye.x + t * ray.x, eye.z + t * ray.z);
    }
  return sum / (kSteps * kSteps);
}

TEST(library, point_light_has_the_expected_mean) {
  const auto scene = load("light-point");
  const auto& light = std::get<PointLightDescription>(scene.emitters.at(0).light);
  const double h = light.position.y, albedo = 0.5;
  const double mean = image_mean(scene, [&](double x, double z) {
    return albedo / pi * light.intensity.x * h / std::pow(h * h + x * x + z * z, 1.5);
  });
  EXPECT_NEAR(mean, read_expect(kLibrary + "light-point/expect.toml").analytic->mean->x, 1e-6);
}

TEST(library, area_light_has_the_expected_mean) {
  const auto scene = load("light-area");
  const ShapeDescription& light = light_of(scene);
  const double h = light.to_world.point({0, 0, 0}).y, s = sides(light).x / 2, albedo = 0.5;
  EXPECT_EQ(constant(std::get<DiffuseDescription>(scene.bsdfs.at(light.bsdf.value).model).reflectance), RgbD(0.0));
  // Irradiance per radiance from the parallel rectangle between the point above the receiver and (a,b): pi times the
  // view factor of a plane element, e.g. in Howell's catalogue, B-4.
  const auto f = [h](double a, double b) {
    const double ha = std::hypot(h, a), hb = std::hypot(h, b);
    return (a / ha * std::atan(b / ha) + b / hb * std::atan(a / hb)) / 2;
  };
  const double mean = image_mean(scene, [&](double x, double z) {
    return albedo / pi * constant(*light.radiance).x *
           (f(s - x, s - z) - f(-s - x, s - z) - f(s - x, -s - z) + f(-s - x, -s - z));
  });
  EXPECT_NEAR(mean, read_expect(kLibrary + "light-area/expect.toml").analytic->mean->x, 1e-6);
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
