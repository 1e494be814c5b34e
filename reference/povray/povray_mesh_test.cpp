// POV-Ray itself on meshes: it must show the side that Mitsuba's rules make the front, at the expected brightness.
#include "reference/povray/povray_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "reference/engines/not_representable.h"
#include "reference/povray/povray_engine.h"
#include "scenes/meshes/icosphere.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_povray {
namespace {

MeshDescription described(const TriangleMesh& mesh, bool face_normals) {
  return {MeshDescription::Format::ply, "cube.ply", face_normals, false, std::make_shared<const TriangleMesh>(mesh)};
}

/// The plane of the scene light-point, [-1,1]^2 times 4, as two triangles that face +z before to_world.
SceneDescription mesh_plane() {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/light-point/scene.xml");
  TriangleMesh mesh;
  mesh.resize_positions(4);
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.shapes.at(0).geometry = described(mesh, true);
  return scene;
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const float v : image.rgb) sum += static_cast<double>(v);
  return sum / static_cast<double>(image.rgb.size());
}

double mean(const SceneDescription& scene) {
  return mean_of(render_povray(export_povray(scene, {.width = 24, .height = 24, .grid = 1})).rendering.mean);
}

TEST(povray_mesh_render, shows_the_front_as_it_shows_a_rectangle) {
  const double rectangle = mean(parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/light-point/scene.xml"));
  ASSERT_GT(rectangle, 0);
  EXPECT_NEAR(mean(mesh_plane()), rectangle, 1e-3 * rectangle) << "half floats keep 11 bits";
}

TEST(povray_mesh_render, is_black_from_behind_when_flipped_but_not_when_mirrored) {
  SceneDescription flipped = mesh_plane();
  flipped.shapes.at(0).flip_normals = true;
  EXPECT_EQ(mean(flipped), 0);
  SceneDescription mirrored = mesh_plane();
  mirrored.shapes.at(0).to_world = mirrored.shapes.at(0).to_world * Transform::scale({-1, 1, 1});
  EXPECT_GT(mean(mirrored), 0);
  mirrored.shapes.at(0).flip_normals = true;
  EXPECT_EQ(mean(mirrored), 0);
}

/// [-1,1]^3, outward; with `split` every face has vertices of its own.
TriangleMesh cube_mesh(bool split) {
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  TriangleMesh mesh;
  mesh.resize_positions(split ? 24 : 8);
  const auto corner = [](std::uint32_t i) {
    return Vec3f{(i & 1) != 0 ? 1.0f : -1.0f, (i & 2) != 0 ? 1.0f : -1.0f, (i & 4) != 0 ? 1.0f : -1.0f};
  };
  for (std::uint32_t f = 0; f < 6; ++f) {
    std::array<std::uint32_t, 4> v{};
    for (std::uint32_t k = 0; k < 4; ++k) {
      v[k] = split ? 4 * f + k : faces[f][k];
      mesh.positions[v[k]] = corner(faces[f][k]);
    }
    mesh.triangles.push_back({v[0], v[1], v[2]});
    mesh.triangles.push_back({v[0], v[2], v[3]});
  }
  return mesh;
}

TEST(povray_mesh, is_a_body_where_it_is_closed_and_its_front_outside) {
  ShapeDescription shape;
  const auto is_closed = [&](const TriangleMesh& mesh) {
    return place_mesh(shape, std::make_shared<const TriangleMesh>(mesh), false, 0).is_closed();
  };
  TriangleMesh cube = cube_mesh(false);
  EXPECT_TRUE(is_closed(cube));
  EXPECT_TRUE(is_closed(cube_mesh(true)));
  std::swap(cube.triangles[5][0], cube.triangles[5][1]);
  EXPECT_FALSE(is_closed(cube)) << "a face turned over";
  cube = cube_mesh(false);
  cube.triangles.pop_back();
  EXPECT_FALSE(is_closed(cube)) << "a hole";
  shape.flip_normals = true;
  EXPECT_FALSE(is_closed(cube_mesh(false))) << "inside out";
  shape.to_world = Transform::scale({-1, 1, 1});
  EXPECT_FALSE(is_closed(cube_mesh(false))) << "mirrored, too";
  shape.flip_normals = false;
  EXPECT_TRUE(is_closed(cube_mesh(false))) << "mirrored";
}

TriangleMesh ball_mesh(int level) {
  const Icosphere ball = make_icosphere(level);
  TriangleMesh mesh;
  mesh.resize_positions(ball.directions.size());
  for (std::size_t i = 0; i < ball.directions.size(); ++i) mesh.positions[i] = Vec3f(ball.directions[i]);
  for (const TriangleMesh::Triangle& triangle : ball.triangles) mesh.triangles.push_back(triangle);
  return mesh;
}

/// A cube of ink, and of glass too, under a bright sky.
SceneDescription ink(const std::string& bsdf) {
  return parse_scene_text(R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective">
    <float name="fov" value="50"/><transform name="to_world"><lookat origin="2,3,5" target="0,0,0" up="0,1,0"/></transform>
    <film type="hdrfilm"><rfilter type="box"/></film></sensor><emitter type="constant"/>
    <medium type="homogeneous" id="ink"><rgb name="sigma_t" value="0.1,0.3,1"/><rgb name="albedo" value="0"/></medium>
    <shape type="cube"><transform name="to_world"><rotate x="1" y="2" z="3" angle="40"/><scale x="1.2"/></transform>
    <bsdf type=")" + bsdf + R"("/><ref name="interior" id="ink"/></shape></scene>)",
                          "ink.xml");
}

Image shown(const SceneDescription& scene) {
  return render_povray(export_povray(scene, {.width = 32, .height = 32, .grid = 2})).rendering.mean;
}

TEST(povray_mesh_render, of_glass_and_ink_is_what_a_cube_of_them_is) {
  for (const std::string bsdf : {"dielectric", "null"}) {
    SceneDescription scene = ink(bsdf);
    const Image box = shown(scene);
    EXPECT_LT(box.pixel(16, 16)[2], 0.5) << "the ink is seen";
    scene.shapes.at(0).geometry = described(cube_mesh(false), true);
    const Image mesh = shown(scene);
    for (std::size_t i = 0; i < box.rgb.size(); ++i) ASSERT_NEAR(mesh.rgb[i], box.rgb[i], 1e-3) << bsdf << " " << i;
  }
}

// Light that is reflected totally by one facet after the other leaves after dozens of bounces: where all around is 1,
// so is lossless glass. Where rays end after 20 bounces 0.28 % of the picture is missing.
TEST(povray_mesh_render, of_glass_facets_loses_no_light) {
  SceneDescription scene = ink("dielectric");
  scene.shapes.at(0).interior.reset();
  scene.shapes.at(0).geometry = described(ball_mesh(1), true);
  EXPECT_NEAR(mean_of(shown(scene)), 1, 5e-4);
}

// A light behind the ball is seen in slivers, which may lie between a pixel's corners.
TEST(povray_mesh_render, of_glass_facets_shows_all_of_a_light) {
  SceneDescription scene = parse_scene_text(R"(<scene version="3.0.0"><integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="40"/><transform name="to_world">
    <lookat origin="1,3,5" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"><rfilter type="box"/></film></sensor>
    <shape type="sphere"><bsdf type="dielectric"/></shape>
    <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><scale value="2"/><translate y="5"/>
    </transform><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><emitter type="area"/></shape>
    <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="6"/>
    <translate y="-1.3"/></transform></shape></scene>)",
                                            "lamp.xml");
  scene.shapes.at(0).geometry = described(ball_mesh(1), true);
  const PovrayExport apart = export_povray(scene, {.width = 32, .height = 32, .lights_apart = true});
  ASSERT_EQ(apart.besides.size(), 1u);
  PovrayExport finer = apart.besides.at(0);
  finer.grid = 32;
  const double expected = mean_of(render_povray(finer).rendering.mean);
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(mean_of(render_povray(apart.besides.at(0)).rendering.mean), expected, 0.04 * expected)
      << "16 for 32 lines";
}

TEST(povray_mesh, of_glass_has_nothing_in_the_box_around_it) {
  SceneDescription scene = ink("dielectric");
  scene.shapes.at(0).geometry = described(cube_mesh(false), true);
  ShapeDescription ball;
  ball.geometry = SphereDescription{{0, 0, 4}, 1};
  ball.bsdf = scene.shapes.at(0).bsdf;
  scene.shapes.push_back(ball);
  EXPECT_NO_THROW(export_povray(scene, {}));
  std::get<SphereDescription>(scene.shapes.at(1).geometry) = {{1.4, 1.4, 1.4}, 0.2};
  try {
    export_povray(scene, {});
    FAIL();
  } catch (const NotRepresentable& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("a surface inside or across the box around the dielectric of ink.xml"),
              std::string::npos)
        << refusal.what();
  }
}

}  // namespace
}  // namespace photonproof::inline reference_povray
