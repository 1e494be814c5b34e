// Every value rendered as another, and every unintentionally dark light, has a note; the tests compare the whole
// sentence.

#include "renderer/limits/scene_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/limits/precision_notes.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_limits {
namespace {

/// "file:line:col: text" of all notes, a line each.
std::string notes_of(const SceneDescription& d) {
  std::string text;
  const SceneParts scene(d, 4, 4);
  for (const SceneNote& note : scene_notes(d, scene)) text += note.where + ": " + note.text + "\n";
  return text;
}

/// The entities of `body` stand in line 2 of the file from column 1 on.
std::string notes_of_scene(const std::string& body) {
  return notes_of(parse_scene_text(
      "<scene version=\"3.0.0\">\n" + body +
          "\n<integrator type=\"path\"/><sensor type=\"perspective\"/><emitter type=\"constant\"/></scene>\n",
      "s.xml"));
}

TEST(scene_notes, ordinary_scenes_have_none) {
  EXPECT_EQ(notes_of(test::room(4, true)), "");
  EXPECT_EQ(notes_of_scene("<bsdf type=\"roughconductor\" id=\"b\"><float name=\"alpha\" value=\"1e-4\"/></bsdf>"), "");
  EXPECT_EQ(notes_of_scene("<bsdf type=\"phong\" id=\"b\"><float name=\"exponent\" value=\"1e7\"/></bsdf>"), "");
}

TEST(scene_notes, say_which_lights_an_irradiancemeter_does_not_measure) {
  const std::string meter =
      "<shape type='rectangle'><sensor type='irradiancemeter'><film type='hdrfilm'><integer name='width' value='1'/>"
      "<integer name='height' value='1'/></film></sensor></shape>";
  const auto notes = [&](const std::string& light) {
    return notes_of(parse_scene_text("<scene version='3.0.0'>" + meter + light + "</scene>", "s.xml"));
  };
  EXPECT_EQ(notes("<emitter type='constant'/>"), "");
  EXPECT_EQ(notes("<emitter type='point'><point name='position' x='0' y='0' z='1'/></emitter>"),
            "s.xml:1:48: an irradiancemeter does not measure lights without size, which no ray meets; a white diffuse "
            "floor shows it, as its radiance times pi\n");
  EXPECT_EQ(notes("<emitter type='sunsky'/>"),
            "s.xml:1:48: an irradiancemeter hardly measures the sun, which few of its rays meet; a white diffuse floor "
            "shows it, as its radiance times pi\n");
}

/// A square, lit by a ball light of this radius above it, all of it moved, seen across 4 from `away`.
SceneDescription far_or_large(double area_light, double moved, double away) {
  SceneDescription d;
  test::add_shape(d, RectangleDescription{}, Transform::translate({moved, 0, 0}) * Transform::scale(Vec3d(8)),
                  test::add_bsdf(d, DiffuseDescription{}));
  ShapeDescription& ball =
      test::add_shape(d, SphereDescription{},
                      Transform::translate({moved, 0, 5 + area_light}) * Transform::scale(Vec3d(area_light)), {0});
  ball.radiance = RgbD(1);
  test::set_camera(d, Transform::look_at({moved, 0, away}, {moved, 0, 0}, {0, 1, 0}),
                   2 * std::atan(2 / away) * 180 / std::numbers::pi, 64);
  auto& camera = std::get<PerspectiveDescription>(d.sensor.camera);
  camera.near_clip = away / 4;
  camera.far_clip = 4 * away;
  return d;
}

// Losses of double and single precision: coordinates far out, directions of pixels, points of a light.
TEST(scene_notes, say_what_is_too_far_or_too_large_for_precision) {
  using testing::HasSubstr;
  EXPECT_EQ(notes_of(far_or_large(1, 0, 4)), "");
  EXPECT_EQ(notes_of(far_or_large(1e5, 1e11, 4)), "");
  EXPECT_EQ(notes_of(far_or_large(1, 0, 1e5)), "");
  EXPECT_THAT(notes_of(far_or_large(1, 1e13, 4)), HasSubstr("coordinates in double precision are 0.0022 apart"));
  EXPECT_EQ(notes_of(far_or_large(1e13, 0, 4)), "");
  SceneDescription pipe = far_or_large(1, 0, 4);
  pipe.shapes.back().geometry = CylinderDescription{{-1e16, 0, 6}, {1e16, 0, 6}, 1};
  EXPECT_THAT(notes_of(pipe), HasSubstr("the light reaches to 1e+16, where coordinates in double precision are 2.2"));
  EXPECT_THAT(notes_of(far_or_large(1, 0, 1e6)), HasSubstr("a pixel is "));
}

TEST(scene_notes, say_what_grazes_more_exactly_than_precision) {
  const Transform turn = Transform::rotate({1, 2, 3}, 40);
  SceneDescription d;
  d.files = {"s.xml"};
  test::add_shape(d, RectangleDescription{}, turn, test::add_bsdf(d, DiffuseDescription{}));
  test::set_camera(d, turn * Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 30, 4);
  d.emitters.push_back({{0, 4, 1}, "", PointLightDescription{turn.point({0.5, 0, 1e-5}), RgbD(1)}});
  d.emitters.push_back({{0, 5, 1}, "", PointLightDescription{turn.point({0.5, 0, 1e-9}), RgbD(1)}});
  d.emitters.push_back({{0, 6, 1}, "", DirectionalLightDescription{turn.vector({1, 0, -1e-5}), RgbD(1)}});
  EXPECT_THAT(
      notes_of(d),
      testing::MatchesRegex(
          "s.xml:4:1: the light is (1e-05|9.9e-06) above a surface, which single precision resolves to [0-9.]+e-0[78]: "
          "light that grazes it there may be off by [0-9.]+ %\n"
          "s.xml:5:1: the light is [0-9.]+e-(08|09) above a surface, which single precision resolves to "
          "[0-9.]+e-0[78]: "
          "light that grazes it there is not known\n"
          "s.xml:6:1: the light's angle to a face has the sine 1e-05, which single precision resolves to [0-9.]+e-08: "
          "light that grazes it there may be off by [0-9.]+ %\n"));
}

TEST(scene_notes, say_lenses_and_fields_of_view_beyond_precision) {
  using testing::HasSubstr;
  const auto seen_by = [](const decltype(SensorDescription::camera)& camera) {
    SceneDescription d = test::room(64, false);
    d.sensor.camera = camera;
    return notes_of(d);
  };
  PerspectiveDescription pinhole;
  pinhole.fov_degrees = 60;
  EXPECT_EQ(seen_by(ThinLensDescription{pinhole, 1e2, 2}), "");
  EXPECT_THAT(
      seen_by(ThinLensDescription{pinhole, 1e3, 2}),
      HasSubstr("rays through a lens of radius 1e+03 miss the point in focus by 0.06 in single precision, and a "
                "pixel is 0.036 wide there"));
  pinhole.fov_degrees = 1e-4;
  EXPECT_THAT(seen_by(pinhole), HasSubstr("a pixel is 2.7e-08 radians wide"));
  EXPECT_THAT(seen_by(ThinLensDescription{pinhole, 0, 2}), HasSubstr("a pixel is 2.7e-08 radians wide"));
  EXPECT_EQ(seen_by(FisheyeDescription{359}), "");
  EXPECT_THAT(seen_by(FisheyeDescription{1e-4}), HasSubstr("a pixel is 2.7e-08 radians wide"));
}

TEST(scene_notes, say_cones_and_fields_of_view_too_narrow_and_too_wide) {
  using testing::HasSubstr;
  const auto spot = [](double cutoff) {
    SceneDescription d = test::room(4, false);
    d.files = {"s.xml"};
    SpotLightDescription light;
    light.to_world = Transform::look_at({0, 0, 0}, {1, 2, 3}, {0, 1, 0});
    light.cutoff_degrees = cutoff;
    light.beam_degrees = cutoff / 2;
    d.emitters.push_back({{0, 2, 1}, "", light});
    return notes_of(d);
  };
  EXPECT_EQ(spot(1e-3), "");
  EXPECT_EQ(spot(1e-6),
            "s.xml:2:1: the cone is 1.7e-08 radians wide, and directions in single precision are 1.2e-07 apart: its "
            "light may be missed\n");
  const auto wide = [](double below) {
    SceneDescription d = test::room(4, false);
    std::get<PerspectiveDescription>(d.sensor.camera).fov_degrees = 180 - below;
    return notes_of(d);
  };
  EXPECT_EQ(wide(0.01), "");
  EXPECT_THAT(wide(1e-4), HasSubstr("the field of view is 0.0001 degrees below 180"));
}

// A point at a height h above a wall of a room that is seen 1.4 across, or so: 25 h^2 / 2 of all paths meet its spot.
TEST(scene_notes, say_spots_that_few_camera_paths_meet) {
  const auto notes = [](double height, double paths) {
    SceneDescription d = test::room(4, false);
    d.files = {"s.xml"};
    d.emitters.push_back({{0, 2, 1}, "", PointLightDescription{{0, 1 - height, 0}, RgbD(1)}});
    std::string text;
    for (const SceneNote& note : notes_on_missed_spots(d, SceneParts(d, 4, 4), paths))
      text += note.where + ": " + note.text + "\n";
    return text;
  };
  EXPECT_EQ(notes(1e-3, 1e9), "");
  EXPECT_EQ(notes(0.5, 1e3), "");
  // Among many lights the note names the first, and the number of the others.
  SceneDescription many = test::room(4, false);
  for (int i = 0; i < 40; ++i)
    many.emitters.push_back({{0, 1, 1}, "", PointLightDescription{{0.02 * i - 0.4, 1 - 1e-3, 0}, RgbD(1)}});
  const std::vector<SceneNote> of_many = notes_on_missed_spots(many, SceneParts(many, 4, 4), 1e6);
  ASSERT_EQ(of_many.size(), 16u);
  EXPECT_THAT(of_many.back().text, testing::HasSubstr("; it is alike with 24 more lights after this one"));
  EXPECT_THAT(notes(1e-3, 1e6),
              testing::MatchesRegex("s.xml:2:1: the light is 0.001 above a surface, and its brightest "
                                    "spot there is reached by [0-9.]+ of 1e[+]06 camera paths: .*\n"));
}

TEST(scene_notes, say_suns_and_media_beyond_precision) {
  const auto sun = [](double aperture, double height = 1) {
    SceneDescription d = test::room(4, false);
    d.files = {"s.xml"};
    SunSkyDescription sky;
    sky.sun_aperture_degrees = aperture;
    sky.sun_direction = normalize(Vec3d{1, 0, height});
    d.emitters.push_back({{0, 2, 1}, "", sky});
    return notes_of(d);
  };
  EXPECT_EQ(sun(1e-3), "");
  EXPECT_EQ(sun(1e-9), "s.xml:2:1: sun_aperture 1e-09 is rendered as 0.0005\n");
  EXPECT_EQ(sun(0.5, -0.01), "s.xml:2:1: the light emits nothing: the sun is below the horizon\n");
  const auto fog = [](double sigma_t, double albedo, double g) {
    SceneDescription d = test::room(4, false);
    d.files = {"s.xml"};
    d.media.push_back(
        {{0, 3, 1}, "fog", HomogeneousDescription{RgbD(sigma_t), RgbD(albedo), 1, HenyeyGreensteinDescription{g}}});
    test::add_shape(d, SphereDescription{}, Transform::scale(Vec3d(0.2)), test::add_bsdf(d, NullDescription{}))
        .interior = MediumIndex{0};
    return notes_of(d);
  };
  EXPECT_EQ(fog(1e30, 0, 0), "");  // what goes through a black one never scatters
  EXPECT_EQ(fog(1e5, 0.99, 0), "");
  EXPECT_EQ(fog(100, 1, 0), "");
  EXPECT_THAT(fog(1e4, 1, 0), testing::MatchesRegex("s.xml:3:1: light is scattered some [56].*e[+]06 times on its way "
                                                    "through 'fog': few paths .*\n"));
  EXPECT_EQ(fog(1e4, 1, 0.999), "");
  SceneDescription all_around = test::room(4, false);
  all_around.media.push_back({{}, "fog", HomogeneousDescription{RgbD(1e4), RgbD(1.0), 1, {}}});
  all_around.sensor.medium = MediumIndex{0};
  EXPECT_THAT(notes_of(all_around), testing::HasSubstr("on its way through 'fog'"));
  EXPECT_THAT(fog(1e9, 0.5, 0),
              testing::HasSubstr("s.xml:3:1: light goes 1e-09 between its scatterings in 'fog', where "
                                 "coordinates in single precision are "));
}

TEST(scene_notes, say_faces_whose_ends_double_precision_does_not_know) {
  const auto tower = [](double height) {
    SceneDescription d;
    test::add_shape(d, CubeDescription{},
                    Transform::translate({0, 0, -height / 2}) * Transform::scale({1, 1, height / 2}),
                    test::add_bsdf(d, DiffuseDescription{}));
    test::set_camera(d, Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 20, 4);
    return notes_of(d);
  };
  EXPECT_EQ(tower(1e10), "");
  EXPECT_THAT(tower(1e14),
              testing::HasSubstr("a face is 1e+14 long and ends near what is seen, which is known to 0.2 in "
                                 "double precision"));
  // One that ends far away does not matter.
  EXPECT_EQ(notes_of(far_or_large(1e13, 0, 4)), "");
}

/// A shape of this size in one of 1, both of a BSDF of their own kind.
std::string notes_of_nested(const decltype(ShapeDescription::geometry)& shape, double size,
                            const decltype(BsdfDescription::model)& model) {
  SceneDescription d = test::room(4, false);
  const Transform turned = Transform::rotate({0, 1, 0}, 30);
  test::add_shape(d, shape, turned, test::add_bsdf(d, model));
  test::add_shape(d, shape, turned * Transform::scale(Vec3d(size)), test::add_bsdf(d, model));
  return notes_of(d);
}

TEST(scene_notes, say_faces_of_glass_that_are_nearer_than_precision) {
  using testing::HasSubstr;
  for (const decltype(ShapeDescription::geometry)& shape :
       {decltype(ShapeDescription::geometry){SphereDescription{}}, {CubeDescription{}}}) {
    EXPECT_EQ(notes_of_nested(shape, 1 - 1e-5, DielectricDescription{}), "");
    EXPECT_THAT(notes_of_nested(shape, 1 - 1e-7, DielectricDescription{}), HasSubstr("a face of glass is "));
    EXPECT_THAT(notes_of_nested(shape, 1, DielectricDescription{}), HasSubstr("a face of glass is 0 from one"));
    EXPECT_EQ(notes_of_nested(shape, 1 - 1e-7, DiffuseDescription{}), "");  // whichever is met looks the same
  }
  // Side by side they lie in one plane and share an edge only.
  SceneDescription row = test::room(4, false);
  const BsdfIndex glass = test::add_bsdf(row, DielectricDescription{});
  test::add_shape(row, RectangleDescription{}, Transform(), glass);
  test::add_shape(row, RectangleDescription{}, Transform::translate({2, 0, 0}), glass);
  EXPECT_EQ(notes_of(row), "");
  test::add_shape(row, CubeDescription{}, Transform::translate({1, 0, 1 + 1e-7}), glass);
  EXPECT_THAT(notes_of(row), HasSubstr("a face of glass is 1e-07 from one"));
}

TEST(scene_notes, say_roughness_beyond_its_limits) {
  EXPECT_EQ(notes_of_scene("<bsdf type=\"roughconductor\" id=\"b\"><float name=\"alpha\" value=\"1e-9\"/></bsdf>"),
            "s.xml:2:1: alpha 1e-09 is rendered as 0.0001\n");
  EXPECT_EQ(notes_of_scene("<bsdf type=\"roughplastic\" id=\"b\"><float name=\"alpha\" value=\"1e-5\"/></bsdf>"),
            "s.xml:2:1: alpha 1e-05 is rendered as 0.0001\n");
  EXPECT_EQ(notes_of_scene("<bsdf type=\"roughdielectric\" id=\"b\"><float name=\"alpha_u\" value=\"0.1\"/>"
                           "<float name=\"alpha_v\" value=\"20000\"/></bsdf>"),
            "s.xml:2:1: alpha_v 20000 is rendered as 10000\n");
}

TEST(scene_notes, say_what_phong_does_not_take) {
  EXPECT_EQ(notes_of_scene("<bsdf type=\"phong\" id=\"b\"><float name=\"exponent\" value=\"2e8\"/></bsdf>"),
            "s.xml:2:1: exponent 2e+08 is rendered as 1e+07\n");
  EXPECT_EQ(notes_of_scene("<bsdf type=\"phong\" id=\"b\"><rgb name=\"diffuse_reflectance\" value=\"0.5 0.75 0.5\"/>"
                           "<rgb name=\"specular_reflectance\" value=\"0.5\"/></bsdf>"),
            "s.xml:2:1: diffuse_reflectance and specular_reflectance add up to 1.25 in a channel: both are rendered "
            "divided by that\n");
}

std::shared_ptr<TriangleMesh> mesh_of(const std::vector<Vec3f>& positions) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) mesh->positions[i] = positions[i];
  for (std::uint32_t t = 0; 3 * t < positions.size(); ++t) mesh->triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  return mesh;
}

SceneDescription light_of(const std::shared_ptr<TriangleMesh>& mesh, const RgbD& radiance) {
  SceneDescription d = test::room(4, false);
  d.files = {"s.xml"};
  test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "light.ply", true, false, mesh}, {}, {0}).radiance =
      radiance;
  d.shapes.back().loc = {0, 7, 3};
  return d;
}

TEST(scene_notes, say_triangles_that_cannot_be_seen_and_lights_of_nothing_else) {
  const Vec3f a(0.0f), b(0, 0, 1), c(1, 0, 0);
  EXPECT_EQ(notes_of(light_of(mesh_of({a, b, c}), RgbD(1))), "");
  EXPECT_EQ(notes_of(light_of(mesh_of({a, b, c, a, a, b}), RgbD(1))),
            "s.xml:7:3: 1 of the 2 triangles of 'light.ply' has no area and cannot be seen\n");
  EXPECT_EQ(notes_of(light_of(mesh_of({a, a, c, a, a, b}), RgbD(1))),
            "s.xml:7:3: 2 of the 2 triangles of 'light.ply' have no area and cannot be seen\n"
            "s.xml:7:3: the shape emits nothing: no triangle of 'light.ply' has an area\n");
  EXPECT_EQ(notes_of(light_of(mesh_of({a, b, c}), RgbD(1e-60))),
            "s.xml:7:3: the shape emits nothing: its light is less than single precision can hold\n");
  EXPECT_EQ(notes_of(light_of(mesh_of({a, b, c}), RgbD(0))), "");
}

TEST(scene_notes, say_lights_whose_files_are_dark) {
  SceneDescription d = test::room(4, false);
  d.files = {"s.xml"};
  auto profile = std::make_shared<IesProfile>();
  profile->vertical_degrees = {0, 90};
  profile->horizontal_degrees = {0};
  profile->candela = {0, 0};
  IesLightDescription ies{"dark.ies", profile, RgbD(1), {}};
  d.emitters.push_back({{0, 4, 1}, "", ies});
  ies.intensity = RgbD(0);  // dark on purpose
  d.emitters.push_back({{0, 5, 1}, "", ies});
  EnvmapDescription map;
  map.filename = "dark.exr";
  map.image = std::make_shared<Image>(4, 4);
  d.emitters.push_back({{0, 6, 1}, "", map});
  EXPECT_EQ(notes_of(d),
            "s.xml:4:1: the light emits nothing: every candela of 'dark.ies' is 0\n"
            "s.xml:6:1: the light emits nothing: every pixel of 'dark.exr' is 0\n");
}

}  // namespace
}  // namespace photonproof::inline renderer_limits
