// Lights, shapes and errors of pbrt scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/images/image.h"
#include "scenes/meshes/ply.h"
#include "scenes/pbrt/octahedral.h"
#include "scenes/pbrt/quadrics.h"
#include "scenes/pbrt/test_pbrt.h"

namespace photonproof::inline scenes_pbrt {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance(const RgbD& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

class PbrtSceneTest : public PbrtTest {
 protected:
  TriangleMesh mesh(const ShapeDescription& shape) const {
    return read_ply((folder_ / "made" / std::get<MeshDescription>(shape.geometry).filename).string());
  }
  /// The front of a mesh's first triangle, in our world.
  Vec3d front(const ShapeDescription& shape) const {
    const TriangleMesh m = mesh(shape);
    const auto corner = [&](std::size_t k) { return shape.to_world.point(Vec3d(m.positions[m.triangles[0][k]])); };
    const Vec3d n = cross(corner(1) - corner(0), corner(2) - corner(0));
    const bool turned = (shape.to_world.determinant() < 0) != shape.flip_normals;
    return normalize(turned ? -n : n);
  }
  template <class Light>
  static const Light& light(const SceneDescription& scene) {
    return std::get<Light>(scene.emitters.at(0).light);
  }
};

constexpr const char* kTriangle = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]";

TEST_F(PbrtSceneTest, a_triangle_faces_where_pbrt_says) {
  // (p1 - p0) x (p2 - p0) is +z. Neither the mirrored world nor a transform that mirrors turns it.
  EXPECT_NEAR(front(world(kTriangle).shapes[0]).z, 1, 1e-6);
  EXPECT_NEAR(front(world(std::string("Scale -1 1 1 ") + kTriangle).shapes[0]).z, 1, 1e-6);
  EXPECT_NEAR(front(world(std::string("Rotate 90 0 1 0 ") + kTriangle).shapes[0]).x, -1, 1e-6) << "+x, mirrored";
  EXPECT_NEAR(front(world(std::string("ReverseOrientation ") + kTriangle).shapes[0]).z, -1, 1e-6);
}

TEST_F(PbrtSceneTest, vertex_normals_decide_the_front) {
  const std::string normals = " \"normal N\" [ 0 0 -1  0 0 -1  0 0 -1 ]";
  EXPECT_NEAR(front(world(kTriangle + normals).shapes[0]).z, -1, 1e-6);
  EXPECT_FALSE(std::get<MeshDescription>(world(kTriangle + normals).shapes[0].geometry).face_normals);
  EXPECT_TRUE(std::get<MeshDescription>(world(kTriangle).shapes[0].geometry).face_normals) << "flat without any";
}

TEST_F(PbrtSceneTest, meshes_have_coordinates_from_below) {
  const SceneDescription scene = world(std::string(kTriangle) + " \"point2 uv\" [ 0 0  1 .25  .5 1 ]");
  EXPECT_NEAR(mesh(scene.shapes[0]).uvs[1].y, .75, 1e-6);
  const SceneDescription textured = world(
      std::string("Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"t\" ") +
      kTriangle);
  const TriangleMesh completed = mesh(textured.shapes[0]);
  ASSERT_EQ(completed.uvs.size(), 3u) << "pbrt's are (0,0), (1,0), (1,1)";
  EXPECT_EQ(completed.uvs[2], (Vec2<float>{1, 0}));
}

TEST_F(PbrtSceneTest, quads_and_files_are_meshes) {
  put("a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  const SceneDescription scene = world(
      "Shape \"plymesh\" \"string filename\" \"a.ply\"\n"
      "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]");
  EXPECT_EQ(mesh(scene.shapes[0]).triangles.size(), 2u);
  EXPECT_NEAR(front(scene.shapes[0]).z, 1, 1e-6);
  EXPECT_EQ(mesh(scene.shapes[1]).triangles.size(), 2u);
  EXPECT_NEAR(front(scene.shapes[1]).z, 1, 1e-6);
}

TEST_F(PbrtSceneTest, quadrics_are_themselves_or_triangles) {
  const SceneDescription scene = world(
      "Translate 1 2 3 Shape \"sphere\" \"float radius\" 2\n"
      "Shape \"disk\" \"float height\" .5 \"float radius\" 3\n"
      "Shape \"cylinder\" \"float zmin\" 0 \"float zmax\" 4\n"
      "Scale 1 2 1 Shape \"sphere\"");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GT(scene.shapes[i].to_world.determinant(), 0) << "ours takes no mirror";
  EXPECT_EQ(scene.shapes[0].to_world.point({0, 0, 0}), Vec3d(-1, 2, 3));
  EXPECT_EQ(scene.shapes[1].to_world.point({0, 0, 0}), Vec3d(-1, 2, 3.5));
  EXPECT_NEAR(scene.shapes[1].to_world.vector({0, 0, 1}).z, 3, 1e-12) << "faces +z";
  EXPECT_EQ(std::get<CylinderDescription>(scene.shapes[2].geometry).p1, Vec3d(0, 0, 4));
  EXPECT_TRUE(std::holds_alternative<MeshDescription>(scene.shapes[3].geometry));
  EXPECT_TRUE(noted("stretched"));
}

TEST_F(PbrtSceneTest, triangles_of_quadrics_face_outward_with_pbrts_coordinates) {
  for (const auto kind : {PbrtQuadric::Kind::sphere, PbrtQuadric::Kind::disk, PbrtQuadric::Kind::cylinder}) {
    PbrtQuadric q{.kind = kind, .radius = 2};
    if (kind == PbrtQuadric::Kind::sphere) q.bottom = -2, q.top = 2;
    if (kind == PbrtQuadric::Kind::disk) q.inner = 1, q.bottom = q.top = .5;
    const TriangleMesh m = triangles_of(q);
    double area = 0;
    for (const auto& t : m.triangles) {
      const Vec3d a(m.positions[t[0]]), n = cross(Vec3d(m.positions[t[1]]) - a, Vec3d(m.positions[t[2]]) - a);
      EXPECT_GT(dot(n, Vec3d(m.normals[t[0]]) + Vec3d(m.normals[t[1]])), 0);
      area += length(n) / 2;
    }
    const double whole = kind == PbrtQuadric::Kind::sphere ? 16 * kPi
                         : kind == PbrtQuadric::Kind::disk ? 3 * kPi
                                                           : 8 * kPi;
    EXPECT_NEAR(area / whole, 1, 2e-3);
  }
  // A sphere's u is the angle from +x towards +y, its v grows from -z to +z.
  const TriangleMesh sphere = triangles_of({});
  for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
    const double phi = double{sphere.uvs[i].x} * 2 * kPi, theta = double{sphere.uvs[i].y} * kPi;
    const Vec3d expected(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    EXPECT_LT(length(Vec3d(sphere.positions[i]) - expected), 1e-5);
  }
}

TEST_F(PbrtSceneTest, objects_are_placed_by_both_transforms) {
  const SceneDescription scene = world(
      "Translate 1 0 0 ObjectBegin \"o\" Translate 0 1 0 Shape \"sphere\" ObjectEnd\n"
      "Identity Scale 2 2 2 ObjectInstance \"o\" Translate 0 0 5 ObjectInstance \"o\"");
  ASSERT_EQ(scene.shapes.size(), 2u);
  const Vec3d own = scene.groups.at(0).shapes.at(0).to_world.point({0, 0, 0});
  EXPECT_EQ(own, Vec3d(1, 1, 0));
  EXPECT_EQ(scene.shapes[0].to_world.point(own), Vec3d(-2, 2, 0));
  EXPECT_EQ(scene.shapes[1].to_world.point(own), Vec3d(-2, 2, 10));
}

TEST_F(PbrtSceneTest, an_rgb_light_is_its_own_radiance) {
  const SceneDescription scene =
      world(std::string("AreaLightSource \"diffuse\" \"rgb L\" [ 4 5 6 ] \"float scale\" 2 ") + kTriangle);
  EXPECT_EQ(constant(*scene.shapes.at(0).radiance), RgbD(8, 10, 12));
}

TEST_F(PbrtSceneTest, other_spectra_of_lights_have_the_luminance_1) {
  const auto radiance = [&](const std::string& l) {
    const SceneDescription scene = world("LightSource \"infinite\" " + l);
    return light<ConstantLightDescription>(scene).radiance;
  };
  EXPECT_EQ(radiance(""), RgbD(1.0));
  EXPECT_NEAR(luminance(radiance("\"blackbody L\" 3000 \"float scale\" 7")), 7, 1e-3);
  EXPECT_GT(radiance("\"blackbody L\" 3000").x, 3 * radiance("\"blackbody L\" 3000").z) << "warm";
  EXPECT_LT(radiance("\"blackbody L\" 20000").x, radiance("\"blackbody L\" 20000").z) << "blue";
  // A black body of 6504 K is nearly D65: white.
  EXPECT_NEAR(radiance("\"blackbody L\" 6504").x, 1, 0.05);
  EXPECT_NEAR(radiance("\"blackbody L\" 6504").z, 1, 0.05);
  EXPECT_NEAR(luminance(radiance("\"spectrum L\" [ 400 9 700 9 ]")), 1, 1e-3) << "whatever its values";
}

TEST_F(PbrtSceneTest, powers_and_illuminances_are_totals) {
  // A point of intensity I emits 4 pi I; a triangle of area 1/2 and radiance L emits pi L / 2 on one side.
  EXPECT_NEAR(light<PointLightDescription>(world("LightSource \"point\" \"float power\" 12")).intensity.x,
              12 / (4 * kPi), 1e-12);
  const std::string area = "AreaLightSource \"diffuse\" \"float power\" 3 ";
  EXPECT_NEAR(constant(*world(area + kTriangle).shapes[0].radiance).y, 6 / kPi, 1e-6);
  EXPECT_NEAR(constant(*world(area + "Scale 2 2 2 " + kTriangle).shapes[0].radiance).y, 6 / kPi / 4, 1e-6);
  EXPECT_NEAR(light<ConstantLightDescription>(world("LightSource \"infinite\" \"float illuminance\" 5")).radiance.x,
              5 / kPi, 1e-12);
  EXPECT_NEAR(light<DirectionalLightDescription>(world("LightSource \"distant\" \"float illuminance\" 5")).irradiance.x,
              5, 1e-12);
  // A spot without edge shines into 2 pi (1 - cos 60).
  const SceneDescription spot = world(
      "LightSource \"spot\" \"float power\" 1 \"float coneangle\" 60 \"float conedeltaangle\" 0 \"point3 to\" [ 1 0 0 "
      "]");
  EXPECT_NEAR(light<SpotLightDescription>(spot).intensity.x, 1 / kPi, 1e-9);
  EXPECT_NEAR(light<SpotLightDescription>(spot).to_world.vector({0, 0, 1}).x, -1, 1e-12) << "+x, mirrored";
}

TEST_F(PbrtSceneTest, distant_light_travels_from_one_point_to_the_other) {
  const SceneDescription scene = world(
      "Rotate 90 0 0 1 LightSource \"distant\" \"point3 from\" [ 1 0 0 ] \"point3 to\" [ 0 0 0 ] \"rgb L\" [ 2 2 2 ]");
  // -x turned by 90 degrees about z is -y.
  EXPECT_NEAR(length(light<DirectionalLightDescription>(scene).direction - Vec3d(0, -1, 0)), 0, 1e-12);
  EXPECT_EQ(light<DirectionalLightDescription>(scene).irradiance, RgbD(2.0));
}

TEST_F(PbrtSceneTest, flat_lights_may_shine_on_both_sides) {
  const SceneDescription scene = world(std::string("AreaLightSource \"diffuse\" \"bool twosided\" true ") + kTriangle);
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_NEAR(front(scene.shapes[0]).z, 1, 1e-6);
  EXPECT_NEAR(front(scene.shapes[1]).z, -1, 1e-6);
  EXPECT_LT(scene.shapes[1].to_world.point({0, 0, 0}).z, scene.shapes[0].to_world.point({0, 0, 0}).z);
}

TEST_F(PbrtSceneTest, equal_areas_of_the_square_are_equal_angles) {
  const auto near = [](const Vec3d& d, double x, double y) {
    const Vec2<double> at = equal_area_square(normalize(d));
    EXPECT_NEAR(at.x, x, 1e-7);
    EXPECT_NEAR(at.y, y, 1e-7);
  };
  near({0, 0, 1}, .5, .5);
  near({1, 0, 0}, 1, .5);
  near({0, 1, 0}, .5, 1);
  near({-1, 0, 0}, 0, .5);
  near({1, 1, -1e-9}, .75, .75);
  near({-1e-9, -1e-9, -1}, 0, 0);
  // Below +x the border is followed from its middle to a corner, by the share of the cap: 1 - sqrt(1 - |z|).
  near({std::sqrt(.75), 1e-12, -.5}, 1, .5 + (1 - std::sqrt(.5)) / 2);
  near({1e-12, std::sqrt(.75), -.5}, .5 + (1 - std::sqrt(.5)) / 2, 1);
  // The cap above z has the share (1 - z) / 2 of the sphere; its edge at +x is a corner of a diamond of that area.
  for (const double z : {.9, .5, .1}) {
    const double half = equal_area_square({std::sqrt(1 - z * z), 0, z}).x - .5;
    EXPECT_NEAR(2 * half * half, (1 - z) / 2, 1e-12);
  }
}

TEST_F(PbrtSceneTest, square_environments_become_latitude_longitude_maps) {
  // Red above pbrt's horizon z = 0, green below it, blue where x > 0.
  Rendering square;
  square.mean = Image(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const double u = (x + .5) / 32 - 1, v = (y + .5) / 32 - 1;
      square.mean.pixel(x, y)[std::abs(u) + std::abs(v) < 1 ? 0 : 1] = 1;
      square.mean.pixel(x, y)[2] = u > 0 ? 1 : 0;
    }
  write_exr((folder_ / "sky.exr").string(), square);
  // Turned so that the light's z is up, which is y.
  const SceneDescription scene =
      world("Rotate -90 1 0 0 LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 3");
  const auto& map = light<EnvmapDescription>(scene);
  EXPECT_EQ(map.scale, 3);
  EXPECT_EQ(map.to_world, Transform());
  const Image image = read_image((folder_ / "made" / map.filename).string());
  ASSERT_EQ(image.width, 2 * image.height);
  for (const int x : {3, image.width / 3, image.width - 5}) {
    EXPECT_EQ(image.pixel(x, image.height / 4)[0], 1) << "the upper half is red";
    EXPECT_EQ(image.pixel(x, 3 * image.height / 4)[1], 1) << "the lower half is green";
  }
  // Our +x is on the left of the middle; pbrt's, mirrored, is on the right.
  EXPECT_EQ(image.pixel(3 * image.width / 4, image.height / 3)[2], 1);
  EXPECT_EQ(image.pixel(image.width / 4, image.height / 3)[2], 0);
}

TEST_F(PbrtSceneTest, comments_and_single_values_are_read) {
  const SceneDescription scene = world(
      "# a comment \"with a string\n"
      "LightSource \"point\" \"rgb I\" [ 1 2 3 ]# right behind\n"
      "\"point3 from\"[1 2 3]");
  EXPECT_EQ(light<PointLightDescription>(scene).position, Vec3d(-1, 2, 3));
}

TEST_F(PbrtSceneTest, all_problems_are_told_at_their_places) {
  EXPECT_EQ(problems("Camera \"perspective\" \"float fow\" 45\n"
                     "WorldBegin\n"
                     "Shape \"torus\" \"float width\" 1\n"
                     "  Foo 1 2 \"three\"\n"
                     "Shape \"sphere\" \"float radius\" [ 1 2 ]\n"
                     "Material \"diffuse\" \"texture reflectance\" \"none\"\n"
                     "Shape \"sphere\"\n"
                     "Shape \"sphere\" \"float radius\" \"x\"\n"
                     "AttributeEnd\n"),
            "scene.pbrt:1:22: Camera 'perspective': parameter 'fow' with type 'float' is not supported here\n"
            "scene.pbrt:3:1: Shape 'torus': is not supported, expected trianglemesh, plymesh, bilinearmesh, "
            "loopsubdiv, curve, sphere, disk or cylinder\n"
            "scene.pbrt:4:3: unknown directive 'Foo'\n"
            "scene.pbrt:5:16: Shape 'sphere': parameter 'radius' expected one number\n"
            "scene.pbrt:6:20: Material 'diffuse': parameter 'reflectance' names the texture 'none' of spectrum, which "
            "is not defined\n"
            "scene.pbrt:8:31: parameter 'radius' is a string, expected a number\n"
            "scene.pbrt:9:1: AttributeEnd without its beginning\n");
  EXPECT_EQ(problems("Camera \"perspective\""), "scene.pbrt: has no WorldBegin: it is no scene of pbrt-v4\n");
  EXPECT_EQ(problems("WorldBegin Shape \"sphere"), "scene.pbrt:1:18: the string has no end in its line\n");
}

TEST_F(PbrtSceneTest, files_stay_inside_the_folder_and_end) {
  put("a.pbrt", "Include \"a.pbrt\"\n");
  EXPECT_EQ(problems("WorldBegin Include \"a.pbrt\""), "a.pbrt:1:9: the file includes itself\n");
  EXPECT_EQ(problems("WorldBegin Include \"../b.pbrt\""),
            "scene.pbrt:1:20: '../b.pbrt' lies outside the scene's folder (--allow-outside permits it)\n");
  EXPECT_EQ(problems("WorldBegin Include \"b.pbrt\""), "scene.pbrt:1:20: no such file: 'b.pbrt'\n");
  std::string deep = "WorldBegin ";
  for (int i = 0; i < 1001; ++i) deep += "AttributeBegin ";
  EXPECT_NE(problems(deep).find("blocks are nested too deeply"), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline scenes_pbrt
