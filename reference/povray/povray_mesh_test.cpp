// POV-Ray itself on meshes: it has to show the side that Mitsuba's rules make the front, as bright as anything else.
#include <gtest/gtest.h>

#include "reference/povray/povray_engine.h"
#include "scenes/parser/parser.h"

namespace photonproof {
namespace {

/// The plane of the scene light-point, [-1,1]^2 times 4, as two triangles that face +z before to_world.
SceneDescription mesh_plane() {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/light-point/scene.xml");
  TriangleMesh mesh;
  mesh.resize_positions(4);
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.shapes.at(0).geometry = MeshDescription{MeshDescription::Format::ply, "plane.ply", true, false,
                                                std::make_shared<const TriangleMesh>(mesh)};
  return scene;
}

double mean(const SceneDescription& scene) {
  const Image image = render_povray(export_povray(scene, {.width = 24, .height = 24, .grid = 1})).rendering.mean;
  double sum = 0;
  for (const float v : image.rgb) sum += static_cast<double>(v);
  return sum / static_cast<double>(image.rgb.size());
}

TEST(povray_mesh_render, shows_the_front_as_it_shows_a_rectangle) {
  const double rectangle = mean(parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/light-point/scene.xml"));
  ASSERT_GT(rectangle, 0);
  EXPECT_NEAR(mean(mesh_plane()), rectangle, 1e-3 * rectangle) << "half floats keep 11 bits";
}

TEST(povray_mesh_render, is_black_from_behind_when_flipped_or_mirrored) {
  SceneDescription flipped = mesh_plane();
  flipped.shapes.at(0).flip_normals = true;
  EXPECT_EQ(mean(flipped), 0);
  SceneDescription mirrored = mesh_plane();
  mirrored.shapes.at(0).to_world = mirrored.shapes.at(0).to_world * Transform::scale({-1, 1, 1});
  EXPECT_EQ(mean(mirrored), 0) << "other than a rectangle, a mesh turns over";
  mirrored.shapes.at(0).flip_normals = true;
  EXPECT_GT(mean(mirrored), 0);
}

}  // namespace
}  // namespace photonproof
