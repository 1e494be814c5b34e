// Normal and bump maps compared with numbers that share no code with them (harness/oracles/mapped_normals.py). The
// tests cover how red, green and slopes tilt the normal, mirroring towards the viewer, and shadowing by bumps. They
// detect an error of 0.1 % in any of them, and every swapped axis or sign.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_scene {
namespace {

enum class Map { normal_map, bump_map };

struct Row {
  Map map;
  bool flips, shadows;
  Vec3f to_camera, to_light;  ///< of any length
  double reflected;           ///< f cos
};

const Row rows[] = {
    {Map::normal_map, false, false, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1826175},
    {Map::normal_map, false, false, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.2102198},
    {Map::normal_map, false, false, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.03790849},
    {Map::normal_map, false, false, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.2094232},
    {Map::normal_map, false, false, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0},
    {Map::normal_map, false, false, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0},
    {Map::normal_map, false, false, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0.220245},
    {Map::normal_map, false, false, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0.02265091},
    {Map::normal_map, false, true, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1826175},
    {Map::normal_map, false, true, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.2066707},
    {Map::normal_map, false, true, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.0372685},
    {Map::normal_map, false, true, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.1793805},
    {Map::normal_map, false, true, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0},
    {Map::normal_map, false, true, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0},
    {Map::normal_map, false, true, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0.1778557},
    {Map::normal_map, false, true, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0.02167176},
    {Map::normal_map, true, false, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1826175},
    {Map::normal_map, true, false, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.2102198},
    {Map::normal_map, true, false, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.03790849},
    {Map::normal_map, true, false, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.2094232},
    {Map::normal_map, true, false, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0.09742405},
    {Map::normal_map, true, false, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0.220245},
    {Map::normal_map, true, false, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0.220245},
    {Map::normal_map, true, false, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0.02265091},
    {Map::normal_map, true, true, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1826175},
    {Map::normal_map, true, true, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.2066707},
    {Map::normal_map, true, true, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.0372685},
    {Map::normal_map, true, true, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.1793805},
    {Map::normal_map, true, true, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0.09550516},
    {Map::normal_map, true, true, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0.1778557},
    {Map::normal_map, true, true, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0.1778557},
    {Map::normal_map, true, true, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0.02167176},
    {Map::bump_map, false, false, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1980931},
    {Map::bump_map, false, false, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.08971851},
    {Map::bump_map, false, false, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.1570074},
    {Map::bump_map, false, false, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.1658942},
    {Map::bump_map, false, false, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0.06467622},
    {Map::bump_map, false, false, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0.06868642},
    {Map::bump_map, false, false, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0},
    {Map::bump_map, false, false, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0},
    {Map::bump_map, false, true, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1980931},
    {Map::bump_map, false, true, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.08866117},
    {Map::bump_map, false, true, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.155157},
    {Map::bump_map, false, true, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.1480465},
    {Map::bump_map, false, true, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0.06378545},
    {Map::bump_map, false, true, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0.05852},
    {Map::bump_map, false, true, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0},
    {Map::bump_map, false, true, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0},
    {Map::bump_map, true, false, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1980931},
    {Map::bump_map, true, false, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.08971851},
    {Map::bump_map, true, false, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.1570074},
    {Map::bump_map, true, false, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.1658942},
    {Map::bump_map, true, false, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0.06467622},
    {Map::bump_map, true, false, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0.06868642},
    {Map::bump_map, true, false, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0.06868642},
    {Map::bump_map, true, false, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0.04176973},
    {Map::bump_map, true, true, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.1980931},
    {Map::bump_map, true, true, {0.3f, 0.1f, 1.0f}, {0.5f, 0.2f, 0.7f}, 0.08866117},
    {Map::bump_map, true, true, {0.3f, 0.1f, 1.0f}, {-0.5f, 0.2f, 0.7f}, 0.155157},
    {Map::bump_map, true, true, {0.3f, 0.1f, 1.0f}, {0.5f, -0.9f, 0.4f}, 0.1480465},
    {Map::bump_map, true, true, {-2.0f, 0.5f, 0.4f}, {0.4f, 0.3f, 0.6f}, 0.06378545},
    {Map::bump_map, true, true, {-2.0f, 0.5f, 0.4f}, {-0.9f, 0.3f, 0.3f}, 0.05852},
    {Map::bump_map, true, true, {1.5f, 1.8f, 0.3f}, {0.9f, -0.3f, 0.3f}, 0.05852},
    {Map::bump_map, true, true, {1.5f, 1.8f, 0.3f}, {-0.6f, -0.2f, 0.5f}, 0.04048926},
};

/// Heights h(x, y) = column / 10 + row / 4 over 4 x 4 texels: 0.4 u + v between the middles of the outer ones.
BitmapDescription heights(const Transform& to_uv) {
  auto image = std::make_shared<Image>(4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) image->pixel(x, y)[c] = 0.1f * static_cast<float>(x) + 0.25f * static_cast<float>(y);
  return {"", image, true, TextureFilter::bilinear, TextureWrap::repeat, to_uv};
}
BitmapDescription colour(const Rgb& rgb) {
  auto image = std::make_shared<Image>(1, 1);
  image->pixel(0, 0)[0] = rgb.x;
  image->pixel(0, 0)[1] = rgb.y;
  image->pixel(0, 0)[2] = rgb.z;
  return {"", image, true, TextureFilter::bilinear, TextureWrap::repeat, {}};
}

/// A square -1..1 at z = 0 of albedo 0.8 under the map.
SceneDescription square(Map map, MappedNormalsDescription options, const Transform& to_uv = {}) {
  SceneDescription d;
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{RgbD(0.8)});
  if (map == Map::normal_map)
    d.textures.push_back({{}, "", colour({0.75f, 0.35f, 0.8f})});
  else
    d.textures.push_back({{}, "", heights(to_uv)});
  const BsdfIndex mapped = map == Map::normal_map
                               ? test::add_bsdf(d, NormalMapDescription{TextureIndex{0}, grey, options})
                               : test::add_bsdf(d, BumpMapDescription{TextureIndex{0}, 1.5, grey, options});
  test::add_shape(d, RectangleDescription{}, {}, mapped);
  test::set_camera(d, Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 25, 4);
  return d;
}

/// Reflection at the middle of the square, by a path from the camera and by one from the light.
struct Reflected {
  double by_camera, by_light;
};
Reflected reflected(const Scene& scene, const Vec3f& to_camera, const Vec3f& to_light) {
  const SceneInterface world(scene);
  Interaction at, other;
  EXPECT_TRUE(world.intersect({to_camera * 3.0f, -to_camera}, 0.4f, TransportMode::radiance, at));
  const float by_camera = evaluate(at, to_camera, to_light, TransportMode::radiance).y;
  EXPECT_TRUE(world.intersect({to_light * 3.0f, -to_light}, 0.4f, TransportMode::importance, at));
  const Interaction& seen = world.seen_from(at, to_camera, other);
  const float by_light = evaluate(seen, to_camera, to_light, TransportMode::importance).y;
  return {double{by_camera}, double{by_light * to_light.z / to_camera.z}};
}

TEST(mapped_normals, reflect_what_the_definitions_say) {
  for (const Row& row : rows) {
    const Scene scene = test::compiled(square(row.map, {row.flips, row.shadows}), 4, 4);
    const Reflected got = reflected(scene, normalize(row.to_camera), normalize(row.to_light));
    const auto number = &row - rows;
    EXPECT_NEAR(got.by_camera, row.reflected, 2e-5 * row.reflected + 1e-7) << "row " << number;
    EXPECT_NEAR(got.by_light, row.reflected, 2e-5 * row.reflected + 1e-7) << "row " << number;
  }
}

TEST(mapped_normals, of_a_mirrored_height_lean_the_other_way) {
  // u becomes 1 - u: the slope along x changes its sign, and the light and the camera with it.
  const Scene plain = test::compiled(square(Map::bump_map, {true, true}), 4, 4);
  const Scene mirrored = test::compiled(
      square(Map::bump_map, {true, true}, Transform::translate({1, 0, 0}) * Transform::scale({-1, 1, 1})), 4, 4);
  const Vec3f to_camera = normalize(Vec3f(0.3f, 0.1f, 1)), to_light = normalize(Vec3f(-0.5f, 0.2f, 0.7f));
  const auto in_mirror = [](const Vec3f& v) { return Vec3f(-v.x, v.y, v.z); };
  const double expected = reflected(plain, to_camera, to_light).by_camera;
  EXPECT_NEAR(reflected(mirrored, in_mirror(to_camera), in_mirror(to_light)).by_camera, expected, 1e-5 * expected);
  EXPECT_GT(std::abs(reflected(mirrored, to_camera, to_light).by_camera - expected), 0.1 * expected);
}

TEST(mapped_normals, seen_from_behind_a_twosided_surface_are_the_fronts_mirror_image) {
  for (const Row& row : rows) {
    SceneDescription d = square(row.map, {row.flips, row.shadows});
    d.shapes[0].bsdf = test::add_bsdf(d, TwoSidedDescription{d.shapes[0].bsdf, d.shapes[0].bsdf});
    const Scene scene = test::compiled(d, 4, 4);
    const auto behind = [](const Vec3f& v) { return normalize(Vec3f(v.x, v.y, -v.z)); };
    const Reflected got = reflected(scene, behind(row.to_camera), behind(row.to_light));
    EXPECT_NEAR(got.by_camera, row.reflected, 2e-5 * row.reflected + 1e-7) << "row " << &row - rows;
    EXPECT_NEAR(got.by_light, row.reflected, 2e-5 * row.reflected + 1e-7) << "row " << &row - rows;
  }
}

TEST(mapped_normals, of_three_maps_one_over_the_other_are_refused) {
  SceneDescription d = square(Map::bump_map, {true, true});
  d.files = {"scene.xml"};
  for (int i = 0; i < 2; ++i)
    d.shapes[0].bsdf = test::add_bsdf(d, BumpMapDescription{TextureIndex{0}, 1, d.shapes[0].bsdf});
  EXPECT_THROW(test::compiled(d, 4, 4), InputError);
  d.shapes[0].bsdf.value -= 1;
  d.bsdfs.pop_back();
  EXPECT_NO_THROW(test::compiled(d, 4, 4));
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
