// Textures: filters, wrapping, orientation, transforms, gradients. Expected numbers are derived by hand.

#include "renderer/textures/texture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photonproof::inline renderer_textures {
namespace {

/// Two columns, two rows of grey: 0 1 over 2 4.
std::shared_ptr<const Image> four_texels() {
  auto image = std::make_shared<Image>(2, 2);
  const float values[4] = {0, 1, 2, 4};
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) image->pixel(i % 2, i / 2)[c] = values[i];
  return image;
}

BitmapTexture bitmap(TextureFilter filter, TextureWrap wrap, const Transform& to_uv = {}) {
  return BitmapTexture({"", four_texels(), true, filter, wrap, to_uv});
}

float at(const BitmapTexture& texture, float u, float v) { return texture.at({u, v}).x; }

TEST(bitmap, its_first_row_is_at_v_0) {
  const BitmapTexture t = bitmap(TextureFilter::nearest, TextureWrap::repeat);
  EXPECT_EQ(at(t, 0.25f, 0.25f), 0);
  EXPECT_EQ(at(t, 0.75f, 0.25f), 1);
  EXPECT_EQ(at(t, 0.25f, 0.75f), 2);
  EXPECT_EQ(at(t, 0.75f, 0.75f), 4);
}

TEST(bitmap, is_linear_between_the_middles_of_texels) {
  const BitmapTexture t = bitmap(TextureFilter::bilinear, TextureWrap::clamp);
  EXPECT_FLOAT_EQ(at(t, 0.25f, 0.25f), 0);
  EXPECT_FLOAT_EQ(at(t, 0.5f, 0.25f), 0.5f);
  EXPECT_FLOAT_EQ(at(t, 0.5f, 0.5f), 7.0f / 4);        // the mean of all four
  EXPECT_FLOAT_EQ(at(t, 0.375f, 0.625f), 31.0f / 16);  // 3/4 of the way down, 1/4 across
}

TEST(bitmap, wraps_as_it_is_told) {
  // At u = 1.25 the second period starts with column 0, its mirror image with column 1, and clamping stays at column 1.
  EXPECT_EQ(at(bitmap(TextureFilter::nearest, TextureWrap::repeat), 1.25f, 0.25f), 0);
  EXPECT_EQ(at(bitmap(TextureFilter::nearest, TextureWrap::mirror), 1.25f, 0.25f), 1);
  EXPECT_EQ(at(bitmap(TextureFilter::nearest, TextureWrap::mirror), -0.25f, 0.25f), 0);
  EXPECT_EQ(at(bitmap(TextureFilter::nearest, TextureWrap::clamp), 7.25f, 0.25f), 1);
  EXPECT_EQ(at(bitmap(TextureFilter::nearest, TextureWrap::clamp), -7.25f, 0.25f), 0);
  // On the border linear interpolation takes in the texel beyond it: the other column, or the same.
  EXPECT_FLOAT_EQ(at(bitmap(TextureFilter::bilinear, TextureWrap::repeat), 0, 0.25f), 0.5f);
  EXPECT_FLOAT_EQ(at(bitmap(TextureFilter::bilinear, TextureWrap::mirror), 0, 0.25f), 0);
  EXPECT_FLOAT_EQ(at(bitmap(TextureFilter::bilinear, TextureWrap::clamp), 1, 0.25f), 1);
}

TEST(bitmap, takes_any_uv) {
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp})
    for (const TextureFilter filter : {TextureFilter::bilinear, TextureFilter::nearest})
      for (const float u : {1e30f, -1e30f, INFINITY, -INFINITY, std::nanf(""), 1e9f, -0.0f, 0x1.fffffep-1f}) {
        const float value = at(bitmap(filter, wrap), u, -u);
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 4);
      }
}

TEST(bitmap, is_looked_up_at_the_transformed_uv) {
  const Transform moved = Transform::translate({0.5, 0, 0}) * Transform::scale({2, 1, 1});
  const BitmapTexture t = bitmap(TextureFilter::nearest, TextureWrap::repeat, moved);
  EXPECT_EQ(at(t, 0.125f, 0.25f), 1);  // 2 x 0.125 + 0.5 = 0.75
  EXPECT_EQ(at(t, 0.375f, 0.75f), 2);  // 1.25
}

TEST(bitmap, has_the_gradient_of_its_interpolation) {
  // In the middle: by u the mean of 1 - 0 and 4 - 2 over half a unit, by v that of 2 - 0 and 4 - 1.
  const Vec2<float> slope = bitmap(TextureFilter::bilinear, TextureWrap::repeat).gradient({0.5f, 0.5f});
  EXPECT_FLOAT_EQ(slope.x, 3);
  EXPECT_FLOAT_EQ(slope.y, 5);
  // Along a turned and stretched u: chain rule. uv' = (v, 3 u), so d/du = 3 d/dv' and d/dv = d/du'.
  Transform turned;
  turned.m = {0, 1, 0, 0, 3, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Vec2<float> other = bitmap(TextureFilter::bilinear, TextureWrap::repeat, turned).gradient({0.5f / 3, 0.5f});
  EXPECT_FLOAT_EQ(other.x, 15);
  EXPECT_FLOAT_EQ(other.y, 3);
  EXPECT_EQ(bitmap(TextureFilter::nearest, TextureWrap::repeat).gradient({0.5f, 0.5f}).x, 0);
}

TEST(bitmap, has_gradients_along_either_side_of_a_picture_that_is_not_square) {
  // 8 texels wide, 2 high: values x + 10 y. A unit of u is 8 texels of 1 each, one of v 2 texels of 10.
  auto image = std::make_shared<Image>(8, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c) image->pixel(x, y)[c] = static_cast<float>(x + 10 * y);
  const BitmapTexture t({"", image, true, TextureFilter::bilinear, TextureWrap::clamp, {}});
  const Vec2<float> slope = t.gradient({0.5f, 0.5f});
  EXPECT_FLOAT_EQ(slope.x, 8);
  EXPECT_FLOAT_EQ(slope.y, 20);
}

TEST(checkerboard, alternates_on_half_units) {
  const std::vector<TextureDescription> board{{{}, "", CheckerboardDescription{RgbD(1), RgbD(0.25), {}}}};
  const Textures textures(board);
  EXPECT_EQ(textures.colour(0, {0.25f, 0.25f}).x, 1);
  EXPECT_EQ(textures.colour(0, {0.75f, 0.25f}).x, 0.25f);
  EXPECT_EQ(textures.colour(0, {0.25f, 0.75f}).x, 0.25f);
  EXPECT_EQ(textures.colour(0, {0.75f, 0.75f}).x, 1);
  EXPECT_EQ(textures.colour(0, {-0.25f, 0.25f}).x, 0.25f);
}

TEST(checkerboard, is_looked_up_at_the_transformed_uv) {
  // uv' = (3 u + 0.25, 2 v - 0.25). Each corner of a step of 0.2 lies on another side when u and v, scale and
  // translation or a sign are swapped.
  const Transform to_uv = Transform::translate({0.25, -0.25, 0}) * Transform::scale({3, 2, 1});
  const std::vector<TextureDescription> board{{{}, "", CheckerboardDescription{RgbD(1), RgbD(0.25), to_uv}}};
  const Textures textures(board);
  EXPECT_EQ(textures.colour(0, {0.05f, 0.2f}).x, 1);       // (0.40, 0.15)
  EXPECT_EQ(textures.colour(0, {0.1f, 0.2f}).x, 0.25f);    // (0.55, 0.15)
  EXPECT_EQ(textures.colour(0, {0.05f, 0.4f}).x, 0.25f);   // (0.40, 0.55)
  EXPECT_EQ(textures.colour(0, {0.05f, 0.1f}).x, 0.25f);   // (0.40, -0.05)
  EXPECT_EQ(textures.colour(0, {0.24f, 0.36f}).x, 0.25f);  // (0.97, 0.47)
  EXPECT_EQ(textures.colour(0, {0.24f, 0.39f}).x, 1);      // (0.97, 0.53)
  EXPECT_EQ(textures.colour(0, {0.26f, 0.36f}).x, 1);      // (1.03, 0.47)
}

TEST(bitmap, is_scaled_within_5_percent_along_each_axis) {
  // Four texels over a tenth of u and a fifth of v: at their edges 2 % of a texel more or less is another texel.
  const Transform to_uv = Transform::scale({10, 5, 1});
  const BitmapTexture t = bitmap(TextureFilter::nearest, TextureWrap::repeat, to_uv);
  EXPECT_EQ(at(t, 0.049f, 0.02f), 0);
  EXPECT_EQ(at(t, 0.051f, 0.02f), 1);
  EXPECT_EQ(at(t, 0.02f, 0.098f), 0);
  EXPECT_EQ(at(t, 0.02f, 0.102f), 2);
}

TEST(checkerboard, may_be_of_textures) {
  std::vector<TextureDescription> list{
      {{}, "", BitmapDescription{"", four_texels(), true, TextureFilter::nearest, TextureWrap::repeat, {}}}};
  list.push_back({{}, "", CheckerboardDescription{TextureIndex{0}, RgbD(0.5), {}}});
  const Textures textures(list);
  EXPECT_EQ(textures.colour(1, {0.75f, 0.75f}).x, 4);
  EXPECT_EQ(textures.colour(1, {0.75f, 0.25f}).x, 0.5f);
}

TEST(mesh_attribute, is_linear_on_a_triangle_or_constant) {
  TriangleMesh mesh;
  mesh.triangles = {{2, 0, 1}, {0, 1, 3}};
  mesh.attributes = {{"vertex_color", {Rgb(1, 2, 3), Rgb(4), Rgb(8), Rgb(99)}}, {"face_heat", {Rgb(5), Rgb(6)}}};
  const Textures textures({{{}, "", MeshAttributeDescription{"vertex_color", 1}},
                           {{}, "", MeshAttributeDescription{"face_heat", 0.5}},
                           {{}, "", MeshAttributeDescription{"vertex_none", 1}}});
  EXPECT_TRUE(textures.has_mesh_attributes());
  // Corners 2, 0, 1 weigh 1/8, 1/2 and 3/8.
  const PlacedPoint at{{}, &mesh, 0, 0.5f, 0.375f};
  EXPECT_EQ(textures.colour(0, {}, &at), Rgb(0.5f + 1.5f + 1, 1 + 1.5f + 1, 1.5f + 1.5f + 1));
  EXPECT_EQ(textures.colour(1, {}, &at), Rgb(2.5f));
  const PlacedPoint on_second{{}, &mesh, 1, 0, 0};
  EXPECT_EQ(textures.colour(0, {}, &on_second), Rgb(1, 2, 3));
  EXPECT_EQ(textures.colour(1, {}, &on_second), Rgb(3));
  EXPECT_EQ(textures.colour(2, {}, &at), Rgb(0.0f));
}

TEST(scaled_texture, is_the_other_times_its_colour) {
  const Textures textures(
      {{{}, "", CheckerboardDescription{RgbD(0.2, 0.3, 0.4), RgbD(0.5), {}}},
       {{}, "", ScaledTextureDescription{TextureIndex{0}, RgbD(2, 1, 0.5)}},
       {{}, "", BitmapDescription{"", four_texels(), true, TextureFilter::bilinear, TextureWrap::repeat, {}}},
       {{}, "", ScaledTextureDescription{TextureIndex{2}, RgbD(3.0)}}});
  EXPECT_FALSE(textures.has_mesh_attributes());
  EXPECT_EQ(textures.colour(1, {0.2f, 0.2f}), Rgb(0.4f, 0.3f, 0.2f));
  EXPECT_EQ(textures.colour(1, {0.7f, 0.2f}), Rgb(1, 0.5f, 0.25f));
  EXPECT_EQ(textures.resolution(3).x, 2);
  const Vec2<float> slope = textures.gradient(2, {0.4f, 0.4f}), steeper = textures.gradient(3, {0.4f, 0.4f});
  EXPECT_NE(slope.x, 0);
  EXPECT_FLOAT_EQ(steeper.x, 3 * slope.x);
  EXPECT_FLOAT_EQ(steeper.y, 3 * slope.y);
}

TEST(texture, as_a_number_is_its_luminance) {
  const std::vector<TextureDescription> one{{{}, "", CheckerboardDescription{RgbD{1, 0, 0}, RgbD{1, 1, 1}, {}}}};
  const Textures textures(one);
  EXPECT_NEAR(textures.number(0, {0.25f, 0.25f}), 0.2127f, 1e-4f);  // Rec. 709's red
  EXPECT_NEAR(textures.number(0, {0.75f, 0.25f}), 1, 1e-5f);
}

}  // namespace
}  // namespace photonproof::inline renderer_textures
