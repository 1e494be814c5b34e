// Grids of media, curves and hair of pbrt scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/curves/curve_set.h"
#include "scenes/files/atomic_file.h"
#include "scenes/pbrt/test_pbrt.h"

namespace photonproof::inline scenes_pbrt {
namespace {

class PbrtGridTest : public PbrtTest {
 protected:
  VolumeGrid grid(const GridVolumeDescription& volume) const {
    return parse_vol(read_file(folder_ / "made" / volume.filename), volume.filename);
  }
  SceneDescription medium(const std::string& parameters) {
    return world("MakeNamedMedium \"a\" " + parameters +
                 "\nMediumInterface \"a\" \"\" Material \"interface\" Shape \"sphere\"");
  }
  CurveSet curves(const SceneDescription& scene, std::size_t shape = 0) const {
    const auto& made = std::get<CurvesDescription>(scene.shapes.at(shape).geometry);
    EXPECT_EQ(made.basis, CurvesDescription::Basis::bspline);
    return parse_curves(read_file(folder_ / "made" / made.filename), made.filename, 4);
  }
};

const std::string kUniform =
    "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"integer nz\" 3 \"point3 p0\" [ 0 0 -1 ] \"point3 p1\" [ 4 2 1 "
    "] "
    "\"float density\" [ 1 2 3 4 5 6 ] ";

TEST_F(PbrtGridTest, a_uniform_grid_is_a_density_times_colours) {
  const SceneDescription scene =
      medium(kUniform + "\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 1 1 1 ] \"float scale\" 5 \"float g\" .5");
  const auto& cloud = std::get<HeterogeneousDescription>(scene.media.at(0).model);
  const VolumeGrid made = grid(std::get<GridVolumeDescription>(cloud.sigma_t));
  EXPECT_EQ(made.width, 2);
  EXPECT_EQ(made.height, 1);
  EXPECT_EQ(made.depth, 3);
  EXPECT_EQ(made.channels, 3);
  EXPECT_EQ(made.values[3], 4);
  EXPECT_EQ(made.values[5], 8);
  EXPECT_EQ(cloud.scale, 5);
  EXPECT_EQ(std::get<RgbD>(cloud.albedo), RgbD(0.5, 1 / 3.0, 0.25));
  EXPECT_EQ(std::get<HenyeyGreensteinDescription>(cloud.phase).g, 0.5);
  const Transform& place = std::get<GridVolumeDescription>(cloud.sigma_t).to_world;
  EXPECT_LT(length(place.vector({1, 1, 1}) * place.vector({1, 1, 1}) - Vec3d(16, 4, 4)), 1e-9);
  EXPECT_TRUE(std::holds_alternative<VolPathDescription>(scene.integrator.method));
  EXPECT_TRUE(noted("outer half of a grid's outer cells"));
}

TEST_F(PbrtGridTest, a_uniform_grid_of_grey_has_one_channel) {
  const SceneDescription scene = medium(kUniform);
  const auto& cloud = std::get<HeterogeneousDescription>(scene.media.at(0).model);
  EXPECT_EQ(grid(std::get<GridVolumeDescription>(cloud.sigma_t)).channels, 1);
  EXPECT_EQ(cloud.scale, 2) << "sigma_a and sigma_s are 1 where they are not given";
  EXPECT_EQ(std::get<RgbD>(cloud.albedo), RgbD(0.5));
}

TEST_F(PbrtGridTest, a_grid_of_colours_has_sums_and_shares) {
  const SceneDescription scene = medium(
      "\"string type\" \"rgbgrid\" \"integer ny\" 2 \"rgb sigma_a\" [ 1 1 1 0 1 2 ] \"rgb sigma_s\" [ 1 3 0 4 1 2 ]");
  const auto& cloud = std::get<HeterogeneousDescription>(scene.media.at(0).model);
  EXPECT_EQ(grid(std::get<GridVolumeDescription>(cloud.sigma_t)).values, (std::vector<float>{2, 4, 1, 4, 2, 4}));
  EXPECT_EQ(grid(std::get<GridVolumeDescription>(cloud.albedo)).values,
            (std::vector<float>{0.5f, 0.75f, 0, 1, 0.5f, 0.5f}));
  const SceneDescription one = medium("\"string type\" \"rgbgrid\" \"rgb sigma_s\" [ 1 3 0 ]");
  EXPECT_EQ(std::get<RgbD>(std::get<HeterogeneousDescription>(one.media.at(0).model).albedo), RgbD(0.5, 0.75, 0));
}

TEST_F(PbrtGridTest, other_grids_are_refused) {
  const auto problem = [&](const std::string& parameters) {
    return problems("WorldBegin\nMakeNamedMedium \"a\" " + parameters);
  };
  EXPECT_NE(problem("\"string type\" \"nanovdb\"").find("names a grid of NanoVDB, which is not read"),
            std::string::npos);
  EXPECT_NE(problem("\"string type\" \"uniformgrid\"").find("expected a \"float density\""), std::string::npos);
  EXPECT_NE(problem("\"string type\" \"uniformgrid\" \"float density\" [ 1 2 ]").find("has 2 values, expected 1"),
            std::string::npos);
  EXPECT_NE(problem("\"string type\" \"uniformgrid\" \"float density\" [ -1 ]").find("negative"), std::string::npos);
  EXPECT_NE(problem("\"string type\" \"rgbgrid\"").find("expected \"rgb sigma_a\""), std::string::npos);
  EXPECT_NE(problem(kUniform + "\"float Lescale\" 1").find("emits light"), std::string::npos);
}

/// The middle part of a uniform cubic B-spline of four points.
Vec3d on_spline(const CurveSet& set, std::size_t first, double t, double& radius) {
  const double s = 1 - t;
  const double weight[4] = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
                            t * t * t / 6};
  Vec3d p(0.0);
  radius = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    p += Vec3d(set.points[first + i].p) * weight[i];
    radius += double{set.points[first + i].radius} * weight[i];
  }
  return p;
}

// Bernstein's polynomials of (0, 0, 0), (1, 2, 0), (2, 0, 1), (3, 1, 0). The width of 0.2 to 0.1 is a diameter, which
// the scale of 2 doubles. The scene is mirrored in x.
TEST_F(PbrtGridTest, a_bezier_curve_becomes_a_spline_of_the_same_points) {
  const SceneDescription scene = world(
      "Scale 2 2 2 Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" [ 0 0 0 1 2 0 2 0 1 3 1 0 ] \"float "
      "width0\" .2 "
      "\"float width1\" .1");
  const CurveSet set = curves(scene);
  ASSERT_EQ(set.points.size(), 4u);
  for (const double t : {0.0, 0.3, 1.0}) {
    const double s = 1 - t, b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
    const Vec3d expected{2 * (b1 + 2 * b2 + 3 * b3), 2 * (2 * b1 + b3), 2 * b2};
    double radius = 0;
    const Vec3d p = on_spline(set, 0, t, radius);
    EXPECT_LT(length(Vec3d(std::abs(p.x), p.y, p.z) - expected), 1e-5);
    EXPECT_NEAR(radius, 0.2 - 0.1 * t, 1e-6);
  }
  EXPECT_TRUE(notes_.empty());
}

TEST_F(PbrtGridTest, curves_of_one_material_are_one_shape) {
  const std::string one = "Shape \"curve\" \"point3 P\" [ 0 0 0 1 2 0 2 0 1 3 1 0 ]\n";
  const SceneDescription scene = world(one + one + "Material \"hair\" " + one);
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(curves(scene).first.size(), 2u);
  EXPECT_EQ(curves(scene, 1).first.size(), 1u);
  EXPECT_TRUE(noted("rendered as tubes"));
  EXPECT_TRUE(noted("'hair' is rendered as principled"));
}

// The quadratic pieces of a B-spline of five points meet in the middles of its control polygon.
TEST_F(PbrtGridTest, splines_of_both_degrees_have_their_pieces) {
  const std::string points =
      "\"point3 P\" [ 0 0 0 1 2 0 2 0 1 3 1 0 4 1 1 ] \"float width\" 1 \"string basis\" \"bspline\" ";
  const CurveSet cubic = curves(world("Shape \"curve\" " + points));
  ASSERT_EQ(cubic.first.size(), 2u);
  double radius = 0;
  EXPECT_LT(length(on_spline(cubic, 0, 1, radius) - on_spline(cubic, 4, 0, radius)), 1e-5);
  EXPECT_NEAR(on_spline(cubic, 0, 0, radius).y, 8 / 6.0, 1e-5);
  const CurveSet quadratic = curves(world("Shape \"curve\" " + points + "\"integer degree\" 2"));
  ASSERT_EQ(quadratic.first.size(), 3u);
  EXPECT_NEAR(on_spline(quadratic, 0, 0, radius).y, 1, 1e-5);
  EXPECT_NEAR(on_spline(quadratic, 0, 0.5, radius).y, 0.25 + 2 * 0.5 + 0.25, 1e-5) << "(0 + 1) / 8 + 6 / 8 * 2 ...";
}

TEST_F(PbrtGridTest, a_pointed_curve_ends_in_a_point) {
  const CurveSet set = curves(world("Shape \"curve\" \"point3 P\" [ 0 0 0 1 0 0 2 0 0 3 0 0 ] \"float width1\" 0"));
  double radius = 0;
  on_spline(set, set.first.back(), 1, radius);
  EXPECT_LT(radius, 0.006);
  EXPECT_GT(set.first.size(), 2u);
  EXPECT_LT(set.first.size(), 20u);
}

TEST_F(PbrtGridTest, wrong_curves_are_refused) {
  const auto problem = [&](const std::string& parameters) {
    return problems("WorldBegin\nShape \"curve\" " + parameters);
  };
  EXPECT_NE(problem("\"point3 P\" [ 0 0 0 ]").find("has 1 points, expected degree + 1"), std::string::npos);
  EXPECT_NE(problem("\"point3 P\" [ 0 0 0 ] \"string basis\" \"a\"").find("expected bezier or bspline"),
            std::string::npos);
  EXPECT_NE(problem("\"point3 P\" [ 0 0 0 ] \"string type\" \"a\"").find("expected flat, cylinder or ribbon"),
            std::string::npos);
  EXPECT_NE(problem("\"point3 P\" [ 0 0 ]").find("P"), std::string::npos);
}

// exp(-5.969 sqrt(a)) with the fit's polynomial at 0.3: 5.969 - 0.0645 + 0.22788 - 0.28971 + 0.04515 + 0.00060
// = 5.88842.
TEST_F(PbrtGridTest, hair_has_the_colour_of_its_absorption) {
  const SceneDescription scene =
      world("Material \"hair\" \"rgb sigma_a\" [ .01 .04 .09 ] \"float beta_m\" .2 Shape \"sphere\"");
  const auto& both = std::get<TwoSidedDescription>(scene.bsdfs.at(scene.shapes[0].bsdf.value).model);
  const auto& hair = std::get<PrincipledDescription>(scene.bsdfs.at(both.front.value).model);
  const RgbD colour = std::get<RgbD>(hair.base_color);
  EXPECT_NEAR(colour.x, std::exp(-0.588842), 1e-5);
  EXPECT_NEAR(colour.z, std::exp(-1.766526), 1e-5);
  EXPECT_EQ(hair.roughness, Scalar(0.2));
}

}  // namespace
}  // namespace photonproof::inline scenes_pbrt
