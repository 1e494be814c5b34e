// Cameras, films and places of pbrt scenes, by their definitions in pbrt's format.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/description/field_of_view.h"
#include "scenes/pbrt/test_pbrt.h"

namespace photonproof::inline scenes_pbrt {
namespace {

class PbrtViewsTest : public PbrtTest {
 protected:
  /// The place of the first light in the camera's frame, of which +x is left in the image.
  static Vec3d in_camera(const SceneDescription& scene) {
    const auto& light = std::get<PointLightDescription>(scene.emitters.at(0).light);
    return scene.sensor.to_world.inverse()->point(light.position);
  }
  static Vec2<double> tangents(const SceneDescription& scene) {
    const auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
    return half_tangents(camera.fov_degrees, camera.fov_axis, scene.sensor.film.width, scene.sensor.film.height);
  }
};

constexpr const char* kLight = "LightSource \"point\" \"point3 from\" [ 1 2 3 ]\n";

TEST_F(PbrtViewsTest, what_has_a_positive_x_is_on_the_right) {
  // A camera without transform is at the origin and looks along +z, with +x on the right.
  const Vec3d place = in_camera(read(std::string("Camera \"perspective\"\nWorldBegin\n") + kLight));
  EXPECT_NEAR(length(place - Vec3d(-1, 2, 3)), 0, 1e-12);
  const SceneDescription mirrored = read(std::string("Scale -1 1 1\nCamera \"perspective\"\nWorldBegin\n") + kLight);
  EXPECT_NEAR(length(in_camera(mirrored) - Vec3d(1, 2, 3)), 0, 1e-12);
  EXPECT_GT(mirrored.sensor.to_world.determinant(), 0);
}

TEST_F(PbrtViewsTest, look_at_is_left_handed) {
  // From (0,0,-5) towards +z with y up, a point at x = 1 is right; from (0,0,11) towards -z it is left.
  EXPECT_LT(in_camera(read(std::string("LookAt 0 0 -5  0 0 0  0 1 0 Camera \"perspective\" WorldBegin ") + kLight)).x,
            0);
  const Vec3d behind =
      in_camera(read(std::string("LookAt 0 0 11  0 0 0  0 1 0 Camera \"perspective\" WorldBegin ") + kLight));
  EXPECT_NEAR(length(behind - Vec3d(1, 2, 8)), 0, 1e-12);
}

TEST_F(PbrtViewsTest, transforms_are_given_by_columns_and_applied_last_first) {
  const SceneDescription scene = world(
      "Translate 10 0 0 Scale 2 2 2 Rotate 90 0 0 1\n"
      "ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  5 0 0 1 ]\n" +
      std::string(kLight));
  // (1,2,3) + (5,0,0) is (6,2,3), turned (-2,6,3), twice (-4,12,6), moved (6,12,6). Our world is mirrored in x.
  EXPECT_NEAR(length(std::get<PointLightDescription>(scene.emitters[0].light).position - Vec3d(-6, 12, 6)), 0, 1e-12);
}

TEST_F(PbrtViewsTest, blocks_and_coordinate_systems_restore_transforms) {
  const SceneDescription scene = world(
      "Translate 1 0 0 CoordinateSystem \"a\" AttributeBegin Translate 0 5 0 AttributeBegin Scale 9 9 9 "
      "AttributeEnd\n" +
      std::string(kLight) + "AttributeEnd\n" + kLight + "Identity CoordSysTransform \"a\"\n" + kLight);
  const auto at = [&](std::size_t i) { return std::get<PointLightDescription>(scene.emitters[i].light).position; };
  EXPECT_EQ(at(0), Vec3d(-2, 7, 3));
  EXPECT_EQ(at(1), Vec3d(-2, 2, 3));
  EXPECT_EQ(at(2), Vec3d(-2, 2, 3));
}

TEST_F(PbrtViewsTest, fov_is_along_the_shorter_axis) {
  const std::string camera = "Camera \"perspective\" \"float fov\" 60 Film \"rgb\" ";
  const double tan30 = std::tan(std::numbers::pi / 6);
  const Vec2<double> wide =
      tangents(read(camera + "\"integer xresolution\" 200 \"integer yresolution\" 100 WorldBegin"));
  EXPECT_NEAR(wide.y, tan30, 1e-12);
  EXPECT_NEAR(wide.x, 2 * tan30, 1e-12);
  const Vec2<double> tall =
      tangents(read(camera + "\"integer xresolution\" 100 \"integer yresolution\" 300 WorldBegin"));
  EXPECT_NEAR(tall.x, tan30, 1e-12);
  EXPECT_NEAR(tall.y, 3 * tan30, 1e-12);
}

TEST_F(PbrtViewsTest, a_screen_window_is_a_part_of_the_picture_plane) {
  // x from 0 to 1 and y from -0.25 to 0.75 of a plane on which the fov of 90 is [-1,1]: half as wide, moved.
  const SceneDescription scene = read(
      "Camera \"perspective\" \"float screenwindow\" [ 0 1 -.25 .75 ]\n"
      "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64 WorldBegin");
  EXPECT_NEAR(tangents(scene).x, 0.5, 1e-12);
  EXPECT_NEAR(tangents(scene).y, 0.5, 1e-12);
  const auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
  EXPECT_NEAR(camera.principal_x, 0.5, 1e-12) << "the axis is at the left border";
  EXPECT_NEAR(camera.principal_y, -0.25, 1e-12) << "three quarters are above the axis";
}

TEST_F(PbrtViewsTest, a_camera_that_is_scaled_has_its_lens_in_world_units) {
  // Scale 1/2 before the camera: a unit of the camera is two of the world.
  const SceneDescription scene =
      read("Scale .5 .5 .5 Camera \"perspective\" \"float lensradius\" .1 \"float focaldistance\" 3 WorldBegin\n");
  const auto& lens = std::get<ThinLensDescription>(scene.sensor.camera);
  EXPECT_NEAR(lens.aperture_radius, 0.2, 1e-12);
  EXPECT_NEAR(lens.focus_distance, 6, 1e-12);
  EXPECT_NEAR(scene.sensor.to_world.determinant(), 1, 1e-12);
}

TEST_F(PbrtViewsTest, an_orthographic_camera_spans_its_screen_window) {
  const SceneDescription scene = read(
      "Camera \"orthographic\" \"float screenwindow\" [ -1 3 -1 1 ]\n"
      "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 32 WorldBegin");
  ASSERT_TRUE(std::holds_alternative<OrthographicDescription>(scene.sensor.camera));
  // Our local x = 1 is the left border, here at pbrt's x = -1, which is our world's x = 1.
  EXPECT_NEAR(length(scene.sensor.to_world.point({1, 0, 0}) - Vec3d(1, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(length(scene.sensor.to_world.point({-1, 0, 0}) - Vec3d(-3, 0, 0)), 0, 1e-12);
}

TEST_F(PbrtViewsTest, defaults_are_those_of_pbrt) {
  const SceneDescription scene = read("WorldBegin");
  EXPECT_EQ(scene.sensor.film.width, 1280);
  EXPECT_EQ(scene.sensor.film.height, 720);
  EXPECT_EQ(scene.sensor.sample_count, 16);
  EXPECT_NEAR(tangents(scene).y, 1, 1e-12);
  EXPECT_EQ(scene.sensor.film.filter.kind, ReconstructionFilter::Kind::gaussian);
  // At most 5 surfaces scatter, so a path has at most 6 edges.
  EXPECT_EQ(std::get<PathDescription>(scene.integrator.method).max_depth, 6);
}

TEST_F(PbrtViewsTest, integrators_and_samplers_are_the_nearest) {
  const SceneDescription bdpt = read(
      "Integrator \"bdpt\" \"integer maxdepth\" 1 Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" "
      "5\n"
      "PixelFilter \"triangle\" \"float xradius\" 1.5 WorldBegin");
  EXPECT_EQ(std::get<BdptDescription>(bdpt.integrator.method).max_depth, 2);
  EXPECT_EQ(bdpt.sensor.sample_count, 15);
  EXPECT_EQ(bdpt.sensor.film.filter.radius, 1.5);
  read("Integrator \"mlt\" WorldBegin");
  EXPECT_TRUE(noted("integrator 'mlt' is rendered as 'path'"));
  const SceneDescription sppm =
      read("Integrator \"sppm\" \"float radius\" .5 \"integer photonsperiteration\" 1000 WorldBegin");
  EXPECT_EQ(std::get<SppmDescription>(sppm.integrator.method).photons, 1000);
}

TEST_F(PbrtViewsTest, filters_with_negative_lobes_keep_their_parameters) {
  using Kind = ReconstructionFilter::Kind;
  const auto filter = [&](const std::string& words) {
    return read("PixelFilter " + words + " WorldBegin").sensor.film.filter;
  };
  EXPECT_EQ(filter("\"mitchell\""), (ReconstructionFilter{.kind = Kind::mitchell}));
  EXPECT_EQ(filter("\"mitchell\" \"float B\" .1 \"float C\" .7 \"float xradius\" 3 \"float yradius\" 3"),
            (ReconstructionFilter{.kind = Kind::mitchell, .b = 0.1, .c = 0.7, .mitchell_radius = 3}));
  EXPECT_EQ(filter("\"sinc\""), (ReconstructionFilter{.kind = Kind::sinc}));
  EXPECT_FALSE(noted("yradius"));
  EXPECT_EQ(filter("\"sinc\" \"float xradius\" 2 \"float tau\" 2"),
            (ReconstructionFilter{.kind = Kind::sinc, .sinc_radius = 2, .tau = 2}));
  EXPECT_TRUE(noted("the filter's yradius is rendered as its xradius"));
}

TEST_F(PbrtViewsTest, iso_and_shutter_scale_all_light) {
  const auto intensity = [&](const std::string& film) {
    const SceneDescription scene = read(film + "\nWorldBegin LightSource \"point\" \"rgb I\" [ 3 3 3 ]");
    return std::get<PointLightDescription>(scene.emitters[0].light).intensity.x;
  };
  EXPECT_NEAR(intensity("Film \"rgb\""), 3, 1e-12);
  EXPECT_NEAR(intensity("Film \"rgb\" \"float iso\" 50"), 1.5, 1e-12);
  EXPECT_NEAR(intensity("Camera \"perspective\" \"float shutterclose\" .25"), 0.75, 1e-12);
}

TEST_F(PbrtViewsTest, crops_are_parts_of_the_film) {
  const std::string film = "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 ";
  EXPECT_EQ(read(film + "\"float cropwindow\" [ .1 .5 0 1 ] WorldBegin").sensor.film.crop,
            (FilmDescription::Crop{10, 0, 40, 50}));
  EXPECT_EQ(read(film + "\"integer pixelbounds\" [ 5 15 10 30 ] WorldBegin").sensor.film.crop,
            (FilmDescription::Crop{5, 10, 10, 20}));
}

}  // namespace
}  // namespace photonproof::inline scenes_pbrt
