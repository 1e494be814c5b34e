// The effect of textures, normal and bump maps and nested BSDFs on hits, alone and in whole images.

#include "renderer/scene/surface_detail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/rays/rays.h"

namespace photonproof::inline renderer_scene {
namespace {

TextureIndex add_texture(SceneDescription& d, const decltype(TextureDescription::pattern)& pattern) {
  d.textures.push_back({{}, "", pattern});
  return {static_cast<std::uint32_t>(d.textures.size() - 1)};
}

/// Grey that rises from `low` to `high` along u between the middles of two texels.
BitmapDescription ramp(float low, float high) {
  auto image = std::make_shared<Image>(2, 1);
  for (int c = 0; c < 3; ++c) {
    image->pixel(0, 0)[c] = low;
    image->pixel(1, 0)[c] = high;
  }
  return {"", image, true, TextureFilter::bilinear, TextureWrap::clamp, {}};
}

BitmapDescription even(const Rgb& rgb) {
  auto image = std::make_shared<Image>(1, 1);
  image->pixel(0, 0)[0] = rgb.x;
  image->pixel(0, 0)[1] = rgb.y;
  image->pixel(0, 0)[2] = rgb.z;
  return {"", image, true, TextureFilter::bilinear, TextureWrap::repeat, {}};
}

/// A square of that BSDF in the xy plane under a point light, seen from above (or below).
SceneDescription square_of(SceneDescription d, BsdfIndex bsdf, bool from_below = false) {
  test::add_shape(d, RectangleDescription{}, {}, bsdf);
  const double side = from_below ? -1 : 1;
  d.emitters.push_back({{}, "", PointLightDescription{{0.5, 0.3, 2 * side}, RgbD(10)}});
  test::set_camera(d, Transform::look_at({0, 0, 4 * side}, {0, 0, 0}, {0, 1, 0}), 25, 16);
  return d;
}

/// Detail where the vertical ray through (x, y) meets the first surface.
SurfaceDetail detail_under(const Scene& scene, float x, float y, float u = 0.5f, float from = 1) {
  const Vec3f direction(0, 0, from > 0 ? -1.0f : 1.0f);
  const SurfaceHit<float> hit = closest_hit<float>(scene.view(), {x, y, from}, direction, no_index, true, false);
  EXPECT_TRUE(hit.valid);
  SurfaceDetail detail;
  detail_at(scene.view(), hit.surface, hit.primitive, hit.p, hit.normal, direction, u, TransportMode::radiance, detail);
  return detail;
}

Image image_of(const SceneDescription& d, std::int64_t spp = 16, unsigned threads = 0,
               std::size_t limit = brute_force_limit) {
  RenderJob job = test::job_with(spp);
  if (threads > 0) job.threads = threads;
  return test::render(d, "path", job, limit).image.mean;
}

TEST(detail, a_texture_is_written_into_the_record) {
  SceneDescription d;
  const TextureIndex texture = add_texture(d, ramp(0, 1));
  const BsdfIndex textured = test::add_bsdf(d, DiffuseDescription{texture});
  const Scene scene = test::compiled(square_of(d, textured), 4, 4);
  EXPECT_TRUE(scene.view().detailed);
  EXPECT_NEAR(detail_under(scene, 0, 0).record[0], 0.5f, 1e-6f);
  EXPECT_NEAR(detail_under(scene, 0.25f, 0.9f).record[2], 0.75f, 1e-6f);  // u = 0.625, 3/4 of the way
}

TEST(detail, a_bump_map_tilts_the_normal_by_its_slope) {
  // Height rises by 0.2 over du = 1/2, which is 1 along x: dp/du = (2, 0, 0) becomes (2, 0, 0.4 x scale). The normal is
  // across it.
  SceneDescription d;
  const TextureIndex texture = add_texture(d, ramp(0, 0.2f));
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
  const BsdfIndex bumped = test::add_bsdf(d, BumpMapDescription{texture, 3, grey});
  const Scene scene = test::compiled(square_of(d, bumped), 4, 4);
  const Vec3f expected = normalize(Vec3f(-1.2f, 0, 2));
  EXPECT_NEAR(length(detail_under(scene, 0.1f, 0.2f).normal - expected), 0, 1e-6f);
  EXPECT_EQ(detail_under(scene, 0.1f, 0.2f).below[0], Vec3f(0, 0, 1));
}

TEST(detail, a_bump_map_of_any_height_tilts_the_normal_by_its_slope) {
  // Turned, so that the tangential part is along every axis.
  const Transform turn = Transform::rotate({1, 2, 3}, 40);
  for (const double scale : {1e-37, 1e-20, 1e-6, 1e3, 1e6, 1e9, 1e15, 1e20, 1e30, 1e38}) {
    SceneDescription d;
    const TextureIndex texture = add_texture(d, ramp(0, 0.2f));
    const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
    const BsdfIndex bumped = test::add_bsdf(d, BumpMapDescription{texture, scale, grey});
    test::add_shape(d, RectangleDescription{}, turn, bumped);
    test::set_camera(d, turn * Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 25, 16);
    const Scene scene = test::compiled(d, 4, 4);
    const Vec3f from(turn.point({0.1, 0.2, 1})), direction(turn.vector({0, 0, -1}));
    const SurfaceHit<float> hit = closest_hit<float>(scene.view(), from, direction, no_index, true, false);
    ASSERT_TRUE(hit.valid);
    SurfaceDetail detail;
    detail_at(scene.view(), hit.surface, hit.primitive, hit.p, hit.normal, direction, 0.5f, TransportMode::radiance,
              detail);
    const double slope = 0.2 * scale, unit = std::max(1.0, slope);
    const Vec3d expected = turn.vector(normalize(Vec3d{-slope / unit, 0, 1 / unit}));
    EXPECT_NEAR(length(Vec3d(detail.normal) - expected), 0, 1e-6) << scale;
  }
}

TEST(detail, a_normal_map_is_in_the_frame_of_dp_du) {
  SceneDescription d;
  const TextureIndex texture = add_texture(d, even({0.8f, 0.5f, 0.9f}));  // n = (0.6, 0, 0.8)
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
  const BsdfIndex mapped = test::add_bsdf(d, NormalMapDescription{texture, grey});
  SceneDescription turned = square_of(d, mapped);
  turned.shapes[0].to_world = Transform::rotate({0, 0, 1}, 90);  // dp/du along y
  EXPECT_NEAR(length(detail_under(test::compiled(turned, 4, 4), 0, 0).normal - Vec3f(0, 0.6f, 0.8f)), 0, 1e-6f);
}

TEST(detail, twosided_shows_its_back_to_rays_from_behind_as_the_fronts_mirror_image) {
  SceneDescription d;
  const TextureIndex texture = add_texture(d, even({0.8f, 0.5f, 0.9f}));
  const BsdfIndex front = test::add_bsdf(d, DiffuseDescription{RgbD(0.25)});
  const BsdfIndex back = test::add_bsdf(d, DiffuseDescription{RgbD(0.75)});
  const BsdfIndex mapped = test::add_bsdf(d, NormalMapDescription{texture, back});
  const BsdfIndex both = test::add_bsdf(d, TwoSidedDescription{front, mapped});
  const Scene scene = test::compiled(square_of(d, both), 4, 4);
  EXPECT_EQ(detail_under(scene, 0, 0).record[0], 0.25f);
  EXPECT_EQ(detail_under(scene, 0, 0).normal, Vec3f(0, 0, 1));
  const SurfaceDetail behind = detail_under(scene, 0, 0, 0.5f, -1);
  EXPECT_EQ(behind.record[0], 0.75f);
  EXPECT_NEAR(length(behind.normal - Vec3f(0.6f, 0, -0.8f)), 0, 1e-6f);
  EXPECT_EQ(behind.below[0], Vec3f(0, 0, -1));
}

TEST(detail, nested_choices_share_one_number_without_bias) {
  // A mask of 0.3 over a blend of 0.25: the leaves' shares are 0.7 nothing, 0.3 x 0.75, 0.3 x 0.25. Stratified numbers
  // meet them to 1 / 10000.
  SceneDescription d;
  const BsdfIndex a = test::add_bsdf(d, DiffuseDescription{RgbD(0.1)});
  const BsdfIndex b = test::add_bsdf(d, ConductorDescription{});
  const BsdfIndex blend = test::add_bsdf(d, BlendDescription{0.25, a, b});
  const BsdfIndex mask = test::add_bsdf(d, MaskDescription{0.3, blend});
  const Scene scene = test::compiled(square_of(d, mask), 4, 4);
  int of_a = 0, of_b = 0;
  for (int i = 0; i < 10'000; ++i) {
    const SurfaceDetail detail = detail_under(scene, 0, 0, (static_cast<float>(i) + 0.5f) / 10'000);
    if (detail.bsdf == a.value) ++of_a;
    if (detail.bsdf == b.value) ++of_b;
  }
  EXPECT_NEAR(of_a, 2250, 2);
  EXPECT_NEAR(of_b, 750, 2);
}

TEST(detail, a_blend_of_diffuse_leaves_has_the_blended_reflectance) {
  // (0.1, 0.5, 0.9) + 0.2 ((0.6, 0.5, 0.4) - (0.1, 0.5, 0.9)) = (0.2, 0.5, 0.8), whatever is drawn.
  SceneDescription d;
  const TextureIndex texture = add_texture(d, even({0.6f, 0.5f, 0.4f}));
  const BsdfIndex a = test::add_bsdf(d, DiffuseDescription{RgbD(0.1, 0.5, 0.9)});
  const BsdfIndex b = test::add_bsdf(d, DiffuseDescription{texture});
  const BsdfIndex blend = test::add_bsdf(d, BlendDescription{0.2, a, b});
  const Scene scene = test::compiled(square_of(d, blend), 4, 4);
  for (const float u : {0.05f, 0.95f}) {
    const SurfaceDetail detail = detail_under(scene, 0, 0, u);
    const double expected[3] = {0.2, 0.5, 0.8};
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(detail.record[channel], expected[channel], 1e-6) << u;
  }
}

/// Six greys, all of them different: 0.1 0.2 0.3 over 0.5 0.7 0.9.
BitmapDescription six_texels(TextureFilter filter = TextureFilter::nearest, const Transform& to_uv = {}) {
  auto image = std::make_shared<Image>(3, 2);
  const float greys[6] = {0.1f, 0.2f, 0.3f, 0.5f, 0.7f, 0.9f};
  for (int i = 0; i < 6; ++i)
    for (int c = 0; c < 3; ++c) image->pixel(i % 3, i / 3)[c] = greys[i];
  return {"", image, true, filter, TextureWrap::repeat, to_uv};
}

/// The part of the paths at (x, y) that get the leaf.
double part_of(const Scene& scene, float x, float y, BsdfIndex leaf) {
  constexpr int steps = 1000;
  int hits = 0;
  for (int i = 0; i < steps; ++i)
    if (detail_under(scene, x, y, (static_cast<float>(i) + 0.5f) / steps).bsdf == leaf.value) ++hits;
  return hits / double{steps};
}

TEST(detail, textures_of_masks_and_blends_lie_where_the_texture_does) {
  // Texels' middles are at u = 1/6, 3/6, 5/6 and v = 1/4, 3/4, the square's at x = 2 u - 1, y = 2 v - 1. A mirrored or
  // transposed texture, an inverted opacity, swapped BSDFs: every one puts another of six greys there.
  SceneDescription d;
  const TextureIndex texture = add_texture(d, six_texels());
  const BsdfIndex a = test::add_bsdf(d, DiffuseDescription{RgbD(0.1)});
  const BsdfIndex b = test::add_bsdf(d, ConductorDescription{});
  const BsdfIndex mask = test::add_bsdf(d, MaskDescription{texture, a});
  const BsdfIndex blend = test::add_bsdf(d, BlendDescription{texture, a, b});
  const Scene masked = test::compiled(square_of(d, mask), 4, 4), blended = test::compiled(square_of(d, blend), 4, 4);
  const float greys[6] = {0.1f, 0.2f, 0.3f, 0.5f, 0.7f, 0.9f};
  for (int i = 0; i < 6; ++i) {
    const float x = (static_cast<float>(i % 3) - 1) * 2 / 3, y = static_cast<float>(i / 3) - 0.5f;
    EXPECT_NEAR(part_of(masked, x, y, a), greys[i], 0.002) << i;
    EXPECT_NEAR(part_of(blended, x, y, b), greys[i], 0.002) << i;
    EXPECT_NEAR(part_of(blended, x, y, a), 1 - greys[i], 0.002) << i;
  }
}

TEST(detail_image, a_texture_lies_on_a_square_as_it_does_in_its_file) {
  // Seen from the front with y up, u runs to the right and v upwards: the file's first row is below. One pixel a texel,
  // in the same light: brightness in proportion to the six greys. Half a texel to the side would be 20 % somewhere.
  SceneDescription d;
  const TextureIndex texture = add_texture(d, six_texels(TextureFilter::bilinear));
  const BsdfIndex textured = test::add_bsdf(d, DiffuseDescription{texture});
  test::add_shape(d, RectangleDescription{}, {}, textured);
  d.emitters.push_back({{}, "", DirectionalLightDescription{{0, 0, -1}, RgbD(std::numbers::pi)}});
  d.sensor.camera = OrthographicDescription{};
  d.sensor.to_world = Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
  d.sensor.film.width = d.sensor.film.height = 6;  // texels are 2 pixels wide and 3 high
  const Image image = image_of(d, 256);
  const float greys[6] = {0.1f, 0.2f, 0.3f, 0.5f, 0.7f, 0.9f};
  for (int row = 0; row < 2; ++row) {
    // Over the height of a pixel around the middle of a texel the other row, which is above and below, has 1/12.
    const auto texel = [&](int column) { return (11 * greys[3 * row + column] + greys[3 - 3 * row + column]) / 12; };
    const int y = row == 0 ? 4 : 1;
    // The pixels right and left of the middle texel's middle are on average a quarter of the way to its neighbour.
    EXPECT_NEAR(test::block_mean(image, 3, y, 1, 1), 0.75f * texel(1) + 0.25f * texel(2), 0.01) << row;
    EXPECT_NEAR(test::block_mean(image, 2, y, 1, 1), 0.75f * texel(1) + 0.25f * texel(0), 0.01) << row;
  }
}

TEST(detail_image, a_mask_lets_its_part_of_the_light_behind_it_through) {
  // A light seen straight through the mask: the mean is 1 - opacity of its radiance.
  for (const double opacity : {0.0, 0.3, 1.0}) {
    SceneDescription d;
    const BsdfIndex black = test::add_bsdf(d, DiffuseDescription{RgbD(0)});
    const BsdfIndex mask = test::add_bsdf(d, MaskDescription{opacity, black});
    test::add_shape(d, RectangleDescription{}, Transform::translate({0, 0, -1}), black).radiance = RgbD(1);
    test::add_shape(d, RectangleDescription{}, {}, mask);
    test::set_camera(d, Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 10, 16);
    const double n = 16 * 16 * 64;
    EXPECT_NEAR(test::image_mean(image_of(d, 64)), 1 - opacity, 4 * std::sqrt(opacity * (1 - opacity) / n) + 1e-6);
  }
}

TEST(detail_image, a_blend_is_the_images_of_both_in_proportion) {
  const auto of = [](const auto& top) {
    SceneDescription d;
    const BsdfIndex a = test::add_bsdf(d, DiffuseDescription{RgbD(0.8)});
    const BsdfIndex b = test::add_bsdf(d, ConductorDescription{});
    const BsdfIndex used = top(d, a, b);
    SceneDescription scene = square_of(d, used);
    test::add_shape(scene, RectangleDescription{},
                    Transform::translate({0, 0, 6}) * Transform::rotate({1, 0, 0}, 180) * Transform::scale(Vec3d(3)), a)
        .radiance = RgbD(1);
    return test::render(scene, "path", test::job_with(256)).image;
  };
  const Rendering a = of([](SceneDescription&, BsdfIndex x, BsdfIndex) { return x; });
  const Rendering b = of([](SceneDescription&, BsdfIndex, BsdfIndex y) { return y; });
  const Rendering both = of([](SceneDescription& d, BsdfIndex x, BsdfIndex y) {
    return test::add_bsdf(d, BlendDescription{0.25, x, y});
  });
  double variance = 0;
  for (const Rendering* r : {&a, &b, &both}) variance += test::image_mean(*r->variance) / (16 * 16);
  EXPECT_NEAR(test::image_mean(both.mean), 0.75 * test::image_mean(a.mean) + 0.25 * test::image_mean(b.mean),
              3 * std::sqrt(variance));
}

TEST(detail_image, twosided_looks_alike_from_both_sides) {
  SceneDescription d;
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
  const BsdfIndex both = test::add_bsdf(d, TwoSidedDescription{grey, grey});
  const double above = test::image_mean(image_of(square_of(d, both)));
  EXPECT_GT(above, 0);
  EXPECT_NEAR(test::image_mean(image_of(square_of(d, both, true))), above, 1e-3 * above);
  EXPECT_EQ(test::image_mean(image_of(square_of(d, grey, true))), 0);
}

/// Everything at once: textured walls, a smooth bumped ball of triangles, a masked twosided leaf.
SceneDescription rich_room() {
  SceneDescription d = test::room(16, false);
  const TextureIndex board = add_texture(d, CheckerboardDescription{RgbD(0.8), RgbD{0.1, 0.2, 0.6}, {}});
  const TextureIndex slope = add_texture(d, ramp(0, 0.5f));
  const BsdfIndex tiles = test::add_bsdf(d, DiffuseDescription{board});
  d.shapes[0].bsdf = tiles;
  const BsdfIndex bumped = test::add_bsdf(d, BumpMapDescription{slope, 1, tiles});
  const BsdfIndex leaf = test::add_bsdf(d, TwoSidedDescription{tiles, bumped});
  const BsdfIndex mask = test::add_bsdf(d, MaskDescription{slope, leaf});
  test::add_shape(d, RectangleDescription{}, Transform::translate({0, -0.3, 0}) * Transform::scale(Vec3d(0.5)), mask);
  test::add_shape(d, SphereDescription{{0.5, 0.2, 0.3}, 0.3}, {}, bumped);
  return d;
}

TEST(detail_image, does_not_depend_on_threads) {
  const Image one = image_of(rich_room(), 16, 1);
  EXPECT_EQ(one.rgb, image_of(rich_room(), 16, 2).rgb);
  EXPECT_EQ(one.rgb, image_of(rich_room(), 16, 7).rgb);
}

TEST(detail_image, is_the_same_in_every_instruction_set_and_through_embree_up_to_noise) {
  const double expected = test::image_mean(image_of(rich_room(), 64));
  for (const Kernels& kernels : available_kernels()) {
    RenderJob job = test::job_with(64);
    job.isa = kernels.isa;
    for (const std::size_t limit : {std::size_t{0}, brute_force_limit})
      EXPECT_NEAR(test::image_mean(test::render(rich_room(), "path", job, limit).image.mean), expected, 0.01 * expected)
          << kernels.isa << ' ' << limit;
  }
}

std::shared_ptr<const TriangleMesh> tent() {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(4);
  mesh->positions[0] = {-1, -1, 0};
  mesh->positions[1] = {1, -1, 0};
  mesh->positions[2] = {0, 1, 0};
  mesh->positions[3] = {0, 0, 1};
  mesh->triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesh->uvs = {{0, 0}, {1, 0}, {0.5f, 1}, {0.5f, 0.5f}};
  return mesh;
}

TEST(detail_image, instances_look_as_the_shapes_placed_directly) {
  SceneDescription d;
  const TextureIndex board = add_texture(d, CheckerboardDescription{RgbD(0.8), RgbD(0.1), {}});
  const BsdfIndex tiles = test::add_bsdf(d, DiffuseDescription{board});
  std::vector<ShapeDescription> members;
  {
    SceneDescription group;
    test::add_shape(group, MeshDescription{MeshDescription::Format::ply, "", false, false, tent()},
                    Transform::translate({0.2, 0, 0}), tiles);
    test::add_shape(group, SphereDescription{{0, 0.8, 0.4}, 0.3}, {}, tiles);
    test::add_shape(group, MeshDescription{MeshDescription::Format::ply, "", true, false, tent()},
                    Transform::translate({-0.7, 0.2, 0}) * Transform::scale(Vec3d(0.4)), tiles);
    members = group.shapes;
  }
  const Transform places[] = {Transform::translate({-1, 0, 0}) * Transform::rotate({0, 0, 1}, 30),
                              Transform::translate({1, 0.2, -0.3}) * Transform::scale(Vec3d(0.7))};
  SceneDescription direct = d, instanced = d;
  instanced.groups.push_back({{}, "", members});
  for (const Transform& place : places) {
    test::add_shape(instanced, InstanceDescription{ShapeGroupIndex{0}}, place, tiles);
    for (ShapeDescription member : members) {
      member.to_world = place * member.to_world;
      direct.shapes.push_back(member);
    }
  }
  for (SceneDescription* scene : {&direct, &instanced}) {
    test::add_shape(*scene, PlaneDescription{}, Transform::translate({0, 0, -0.5}), tiles);
    scene->emitters.push_back({{}, "", PointLightDescription{{1, 2, 5}, RgbD(30)}});
    test::set_camera(*scene, Transform::look_at({0, -3, 5}, {0, 0, 0}, {0, 1, 0}), 40, 32);
  }
  const Image expected = image_of(direct), image = image_of(instanced);
  int different = 0;  // rounding moves a few paths across an edge
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (std::abs(image.rgb[i] - expected.rgb[i]) > 1e-3f * (image.rgb[i] + expected.rgb[i])) ++different;
  EXPECT_LT(different, static_cast<int>(image.rgb.size() / 30));
  EXPECT_NEAR(test::image_mean(image), test::image_mean(expected), 0.01 * test::image_mean(expected));
  const Scene scene = test::compiled(instanced, 4, 4);
  EXPECT_EQ(scene.surfaces.size(), 7u);
  EXPECT_EQ(scene.primitives, 2u * 3u + 2u + 2u + 1u);  // triangles once, instances, spheres, plane
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
