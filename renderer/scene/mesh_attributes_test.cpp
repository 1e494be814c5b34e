// Attributes of meshes and volumes as textures: their place in the image, and refusals of what has none.

#include <gtest/gtest.h>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/scene/test_square_mesh.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline renderer_scene {
namespace {

/// Two triangles over [-1,1]^2. The attribute of the vertices is 1/2 + x/4, 1/2 + y/8, 0.4; that of the faces 1/4 below
/// the diagonal from (-1,-1) and 3/4 above it.
std::shared_ptr<const TriangleMesh> painted_square() {
  auto mesh = test::square_mesh();
  MeshAttribute colour{"vertex_color", {}};
  for (const Vec3f& p : mesh->positions) colour.values.emplace_back(0.5f + p.x / 4, 0.5f + p.y / 8, 0.4f);
  mesh->attributes = {colour, {"face_heat", {Rgb(0.25f), Rgb(0.75f)}}};
  return mesh;
}

MeshDescription square_file() { return {MeshDescription::Format::ply, "square.ply", true, false, painted_square()}; }

/// The square with this texture, seen from above under a sky of radiance 1: a point shows its albedo.
SceneDescription scene_of(const decltype(TextureDescription::pattern)& texture, bool instanced = false) {
  SceneDescription d;
  d.textures.push_back({{}, "", texture});
  const BsdfIndex paint = test::add_bsdf(d, DiffuseDescription{TextureIndex{0}});
  if (instanced) {
    ShapeDescription square;
    square.geometry = square_file();
    square.bsdf = paint;
    d.groups.push_back({{}, "g", {square}});
    test::add_shape(d, InstanceDescription{ShapeGroupIndex{0}}, Transform::translate({0, 0, -2}), paint);
  } else {
    test::add_shape(d, square_file(), {}, paint);
  }
  d.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  d.sensor.camera = OrthographicDescription{};
  d.sensor.to_world = Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
  d.sensor.film.width = d.sensor.film.height = 4;
  return d;
}

TEST(mesh_attributes, are_seen_where_their_vertices_are) {
  for (const bool instanced : {false, true})
    for (const char* integrator : {"path", "bdpt", "volpath", "photonmapper"}) {
      RenderJob job = test::job_with(1024);
      job.budget.photons.reset();
      const Image image = test::render(scene_of(MeshAttributeDescription{"vertex_color", 1}, instanced), integrator,
                                       job, instanced ? 0 : 128)
                              .image.mean;
      // Pixel middles are at -3/4, -1/4, 1/4, 3/4; the first row is above.
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
          const double px = 0.5 * x - 0.75, py = 0.75 - 0.5 * y;
          EXPECT_NEAR(image.pixel(x, y)[0], 0.5 + px / 4, 0.02) << integrator << x << y;
          EXPECT_NEAR(image.pixel(x, y)[1], 0.5 + py / 8, 0.02) << integrator << x << y;
          EXPECT_NEAR(image.pixel(x, y)[2], 0.4, 0.02) << integrator << x << y;
        }
    }
}

TEST(mesh_attributes, of_faces_are_constant_and_scaled) {
  const Image image =
      test::render(scene_of(MeshAttributeDescription{"face_heat", 1.25}), "path", test::job_with(1024)).image.mean;
  EXPECT_NEAR(image.pixel(3, 0)[0], (0.3125 + 0.9375) / 2, 0.02) << "half of the pixel on the diagonal";
  EXPECT_NEAR(image.pixel(2, 3)[1], 0.3125, 0.01);
  EXPECT_NEAR(image.pixel(0, 1)[2], 0.9375, 0.01);
}

std::string refusal(const SceneDescription& d) {
  try {
    SceneParts parts(d, 4, 4);
    return "";
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("error: ") + 7);
  }
}

TEST(mesh_attributes, that_are_missing_are_errors_with_the_mesh_and_its_own) {
  for (const bool instanced : {false, true})
    EXPECT_EQ(refusal(scene_of(MeshAttributeDescription{"vertex_colour", 1}, instanced)),
              "mesh 'square.ply' has no attribute 'vertex_colour': it has vertex_color, face_heat");
  SceneDescription ball = scene_of(MeshAttributeDescription{"vertex_color", 1});
  ball.shapes[0].geometry = SphereDescription{};
  EXPECT_EQ(refusal(ball), "the shape has no attribute 'vertex_color', which only the mesh of a file can have");
  EXPECT_EQ(refusal(scene_of(MeshAttributeDescription{"face_heat", 2})),
            "attribute 'face_heat' of mesh 'square.ply' has the value 1.5, expected from 0 to 1; a scale of 0.00392 "
            "makes shares of "
            "bytes");
}

TEST(mesh_attributes, are_checked_below_wrapping_bsdfs_and_textures) {
  SceneDescription d = scene_of(MeshAttributeDescription{"vertex_none", 1});
  d.textures.push_back({{}, "", ScaledTextureDescription{TextureIndex{0}, RgbD(0.5)}});
  const BsdfIndex paint = test::add_bsdf(d, DiffuseDescription{TextureIndex{1}});
  d.shapes[0].bsdf = test::add_bsdf(d, MaskDescription{0.5, paint});
  EXPECT_EQ(refusal(d), "mesh 'square.ply' has no attribute 'vertex_none': it has vertex_color, face_heat");
}

TEST(mesh_attributes, are_refused_where_only_a_function_of_uv_will_do) {
  SceneDescription light = scene_of(MeshAttributeDescription{"vertex_color", 1});
  light.shapes[0].radiance = TextureIndex{0};
  EXPECT_EQ(refusal(light), "a light cannot have the mesh attribute 'vertex_color' as its texture");
  SceneDescription bump = scene_of(MeshAttributeDescription{"vertex_color", 1});
  const BsdfIndex grey = test::add_bsdf(bump, DiffuseDescription{RgbD(0.5)});
  bump.shapes[0].bsdf = test::add_bsdf(bump, BumpMapDescription{TextureIndex{0}, 1, grey});
  EXPECT_EQ(refusal(bump), "the mesh attribute 'vertex_color' cannot be a bump map");
}

/// A volume over [-1,1]^3. Red is 1/2 + x/4 and green 1/2 + y/8, up to half a cell from the border. Blue is 0.4 at z =
/// 0 and grows by 0.1 a unit.
VolumeTextureDescription painted_space() {
  constexpr int cells = 16;
  VolumeGrid grid;
  grid.width = grid.height = grid.depth = cells;
  grid.channels = 3;
  const auto middle = [](int i) { return (static_cast<float>(i) + 0.5f) / (cells / 2) - 1; };
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        for (const float v : {0.5f + middle(x) / 4, 0.5f + middle(y) / 8, 0.4f + middle(z) / 10})
          grid.values.push_back(v);
  grid.largest = 1;
  GridVolumeDescription volume;
  volume.grid = std::make_shared<const VolumeGrid>(std::move(grid));
  volume.to_world = Transform::scale(Vec3d(2)) * Transform::translate(Vec3d(-0.5));
  return {volume};
}

TEST(volume_textures, are_seen_where_they_are_in_the_world) {
  const ShapeDescription at_the_middle = scene_of(painted_space()).shapes[0];
  ShapeDescription rectangle = at_the_middle, ball = at_the_middle;
  rectangle.geometry = RectangleDescription{};
  ball.geometry = SphereDescription{{0, 0, -2000}, 2000};  // its top is the plane z = 0 within 1/2000
  for (const ShapeDescription& shape : {at_the_middle, rectangle, ball})
    for (const char* integrator : {"path", "bdpt", "volpath", "photonmapper"}) {
      SceneDescription d = scene_of(painted_space());
      d.shapes[0] = shape;
      RenderJob job = test::job_with(1024);
      job.budget.photons.reset();
      const Image image = test::render(d, integrator, job, 0).image.mean;
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
          const double px = 0.5 * x - 0.75, py = 0.75 - 0.5 * y;
          const std::string where = integrator + std::to_string(x) + std::to_string(y);
          EXPECT_NEAR(image.pixel(x, y)[0], 0.5 + px / 4, 0.02) << where;
          EXPECT_NEAR(image.pixel(x, y)[1], 0.5 + py / 8, 0.02) << where;
          EXPECT_NEAR(image.pixel(x, y)[2], 0.4, 0.02) << where;
        }
    }
}

TEST(volume_textures, of_copies_are_those_of_the_copies_place) {
  // The square of the group is moved to z = -2, beyond the volume, whose outer layer is at z = -15/16.
  const Image image = test::render(scene_of(painted_space(), true), "path", test::job_with(1024)).image.mean;
  EXPECT_NEAR(image.pixel(0, 0)[2], 0.4 - 0.1 * 15 / 16, 0.01);
}

TEST(volume_textures, are_refused_where_only_a_function_of_uv_will_do) {
  SceneDescription light = scene_of(painted_space());
  light.shapes[0].radiance = TextureIndex{0};
  EXPECT_EQ(refusal(light), "a light cannot have a volume as its texture");
  SceneDescription bump = scene_of(painted_space());
  const BsdfIndex grey = test::add_bsdf(bump, DiffuseDescription{RgbD(0.5)});
  bump.textures.push_back({{}, "", ScaledTextureDescription{TextureIndex{0}, RgbD(0.5)}});
  bump.shapes[0].bsdf = test::add_bsdf(bump, BumpMapDescription{TextureIndex{1}, 1, grey});
  EXPECT_EQ(refusal(bump), "a volume cannot be a bump map");
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
