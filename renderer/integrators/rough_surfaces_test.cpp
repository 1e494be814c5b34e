// Caustics on rough surfaces that are not Lambertian, where the photon mapper gathers photons by their directions.
// References are closed forms and the path tracer, with every kind of indirect light.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "renderer/integrators/test_photon_scenes.h"
#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::add_bsdf;
using test::job_with;
using test::render;

/// A beam of irradiance 3 along x meets a mirror at 45 degrees and goes straight down to a floor of `model`.
SceneDescription mirrored_beam(const decltype(BsdfDescription::model)& model) {
  SceneDescription scene;
  const Transform face_up = Transform::rotate({1, 0, 0}, -90);
  test::add_shape(scene, RectangleDescription{}, face_up * Transform::scale(Vec3d(1.2)), add_bsdf(scene, model));
  test::add_shape(scene, RectangleDescription{},
                  Transform::translate({0, 6, 0}) * Transform::rotate({0, 0, 1}, 135) * face_up,
                  add_bsdf(scene, ConductorDescription{}));
  DirectionalLightDescription beam;
  beam.direction = {1, 0, 0};
  beam.irradiance = RgbD(3);
  scene.emitters.push_back({{}, "", beam});
  scene.integrator.method = PathDescription{3, 8, false};
  return scene;
}

// All of the light is caustic. Paths of three edges omit light that the floor sends to itself by the mirror. With the
// angle a between the direction to the camera and the mirror direction, straight up, the radiance is
//   `3 (d/pi + s (n+2)/(2 pi) cos^n a)`.
// An exponent of 300 is rough, too, since no ray meets the sun. Of 1e6 photons 6e4 land in view. The test detects a
// loss of 1 % of the photons' energy.
TEST(rough_surfaces, phong_reflects_a_mirrored_beam_as_the_closed_form_says) {
  constexpr int size = 16;
  for (const double n : {2.0, 20.0, 300.0}) {
    SceneDescription scene = mirrored_beam(PhongDescription{n, RgbD(0.3), RgbD(0.5)});
    const double beside = n < 100 ? 1.25 : 0.2;
    test::set_camera(scene, Transform::look_at({0, 2, beside}, {0, 0, 0}, {0, 1, 0}), 14, size);
    const Scene seen = test::compiled(scene, size, size);
    double expected = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const double cosine = -double{test::ray_through_pixel(seen.view(), x, y).direction.y};
        const double lobe = 0.5 * (n + 2) / 2 * std::pow(cosine, n);
        expected += 3 * (0.3 + lobe) / std::numbers::pi / (size * size);
      }
    const double mean = test::image_mean(render(scene, "photonmapper", job_with(64, 1'000'000)).image.mean);
    std::printf("Phong of exponent %g under a mirrored beam / closed form = %.4f\n", n, mean / expected);
    EXPECT_NEAR(mean / expected, 1, 0.006) << n;
  }
}

TEST(rough_surfaces, edges_of_both_paths_count) {
  // Light, mirror, floor, camera: three edges.
  SceneDescription scene = mirrored_beam(PhongDescription{20.0, RgbD(0.3), RgbD(0.5)});
  test::set_camera(scene, Transform::look_at({0, 2, 1.25}, {0, 0, 0}, {0, 1, 0}), 14, 8);
  scene.integrator.method = PathDescription{2, 8, false};
  EXPECT_EQ(test::image_mean(render(scene, "photonmapper", job_with(4, 100'000)).image.mean), 0);
}

// The edge of the beam's patch is in view, so that radii have a bias. A flat floor has the same image and bias as one
// surface and as 8,192 triangles, where neighbouring gathers share the areas of both radii.
TEST(rough_surfaces, of_many_triangles_have_the_bias_of_one_surface) {
  SceneDescription scene = mirrored_beam(PhongDescription{20.0, RgbD(0.3), RgbD(0.5)});
  test::set_camera(scene, Transform::look_at({1, 2, 1.25}, {0.9, 0, 0}, {0, 1, 0}), 40, 32);
  const auto one = render(scene, "photonmapper", job_with(64, 200'000));
  scene.shapes[0].geometry =
      HeightfieldDescription{.columns = 64, .rows = 64, .amplitude = 0, .height = HeightfieldNoise{}};
  const auto many = render(scene, "photonmapper", job_with(64, 200'000));
  const double bias = one.stats.counts.at("relative_bias"), bias_of_many = many.stats.counts.at("relative_bias");
  std::printf("relative bias of a rough floor: %.4f as one surface, %.4f as triangles\n", bias, bias_of_many);
  // Narrow gathers that lost all light would differ from wide ones by the radiance itself. Far above a tenth, its
  // square relative to the image is nearly 1, and the reported root is near 2. Only gathers near the edge may differ.
  EXPECT_GT(bias, 0.01);
  EXPECT_LT(bias, 0.5);
  EXPECT_NEAR(bias_of_many / bias, 1, 0.05);
  EXPECT_NEAR(test::image_mean(many.image.mean) / test::image_mean(one.image.mean), 1, 0.005);
}

/// The room with balls of glass and mirror; its floor and its left wall are of `model`.
SceneDescription rough_room(const decltype(BsdfDescription::model)& model, int size = 32) {
  SceneDescription scene = test::room(size, true);
  const BsdfIndex rough = add_bsdf(scene, model);
  scene.shapes[1].bsdf = scene.shapes[3].bsdf = rough;
  scene.integrator.method = PathDescription{-1, 5, true};
  return scene;
}

struct Material {
  const char* name;
  decltype(BsdfDescription::model) model;
};
std::vector<Material> materials() {
  PlasticDescription plastic;
  plastic.diffuse_reflectance = RgbD{0.7, 0.5, 0.2};
  RoughConductorDescription metal;
  metal.alpha_u = metal.alpha_v = 0.3;
  RoughConductorDescription brushed = metal;
  brushed.alpha_u = 0.6;
  RoughPlasticDescription glossy;  // a sharp coat over a base
  glossy.diffuse_reflectance = RgbD{0.6, 0.6, 0.3};
  RoughPlasticDescription matt = glossy;
  matt.alpha = 0.4;
  return {{"plastic", plastic},
          {"metal", metal},
          {"brushed metal", brushed},
          {"rough plastic of sharp highlights", glossy},
          {"rough plastic of wide ones", matt},
          {"Phong of exponent 10", PhongDescription{10.0, RgbD{0.2, 0.5, 0.3}, RgbD(0.4)}},
          {"Phong of exponent 100", PhongDescription{100.0, RgbD{0.2, 0.5, 0.3}, RgbD(0.4)}},
          {"coated principled", PrincipledDescription{.base_color = RgbD{0.6, 0.6, 0.3}, .clearcoat = 1.0}},
          {"principled, partly glass", PrincipledDescription{.base_color = RgbD{0.6, 0.6, 0.3}, .spec_trans = 0.3}},
          {"thin principled", PrincipledThinDescription{.base_color = RgbD{0.6, 0.6, 0.3}, .spec_trans = 0.3}}};
}

constexpr int seeds_each = 6;

std::vector<Image> path_traced(const SceneDescription& scene) {
  std::vector<Image> images;
  for (int seed = 1; seed <= seeds_each; ++seed)
    images.push_back(render(scene, "path", job_with(384, 0, static_cast<std::uint64_t>(seed))).image.mean);
  return images;
}

/// Checks that the means of image and floor, from independent seeds, agree within four standard errors, which are
/// small.
void expect_means(const std::vector<Image>& paths, const SceneDescription& scene, IndirectLight indirect,
                  const std::string& name) {
  double sums[2][2] = {}, squares[2][2] = {};  // by integrator and part
  for (int seed = 1; seed <= seeds_each; ++seed) {
    RenderJob job = job_with(64, 0, static_cast<std::uint64_t>(seed));
    job.budget.photons.reset();
    const Image photons = render(test::with_indirect(scene, indirect), "photonmapper", job).image.mean;
    const int size = photons.width;
    int k = 0;
    for (const Image* image : {&paths[static_cast<std::size_t>(seed - 1)], &photons}) {
      const double means[] = {test::image_mean(*image), test::block_mean(*image, 0, 3 * size / 4, size, size / 4)};
      for (int part = 0; part < 2; ++part) sums[k][part] += means[part], squares[k][part] += means[part] * means[part];
      ++k;
    }
  }
  for (int part = 0; part < 2; ++part) {
    const double path = sums[0][part] / seeds_each, photons = sums[1][part] / seeds_each;
    double variance = 0;
    for (int k = 0; k < 2; ++k)
      variance += (squares[k][part] / seeds_each - std::pow(sums[k][part] / seeds_each, 2)) / (seeds_each - 1);
    const double error = std::sqrt(variance);
    std::printf("%s, %s: photon mapper / path = %.4f +- %.4f\n", name.c_str(), part == 0 ? "image" : "floor",
                photons / path, error / path);
    EXPECT_LE(error, 0.012 * path) << "too little is seen: " << name;
    // The additional half a percent allows for a caustic blurred over the border of the floor.
    EXPECT_NEAR(photons, path, 4.5 * error + 0.005 * path) << name;
  }
}

void expect_path_tracers_means(const SceneDescription& scene, IndirectLight indirect, const std::string& name) {
  expect_means(path_traced(scene), scene, indirect, name);
}

TEST(rough_surfaces, have_the_path_tracers_means) {
  for (const Material& material : materials())
    expect_path_tracers_means(rough_room(material.model), IndirectLight::map, material.name);
}

TEST(rough_surfaces, have_the_path_tracers_means_with_every_kind_of_indirect_light) {
  const SceneDescription scene = rough_room(materials().back().model);
  const std::vector<Image> paths = path_traced(scene);
  for (const IndirectLight indirect : {IndirectLight::gather, IndirectLight::cache, IndirectLight::path})
    expect_means(paths, scene, indirect, word_of(indirect));
}

// A blend stores photons with a probability, and a gather divides by it; the back of a twosided one has its own
// photons.
TEST(rough_surfaces, inside_blends_and_twosided_have_the_path_tracers_means) {
  SceneDescription scene = rough_room(materials()[5].model);
  const BsdfIndex phong = scene.shapes[1].bsdf;
  const BsdfIndex metal = add_bsdf(scene, materials()[1].model), white = add_bsdf(scene, DiffuseDescription{RgbD(0.7)});
  const BsdfIndex both = add_bsdf(scene, BlendDescription{0.3, phong, metal});
  const BsdfIndex three = add_bsdf(scene, BlendDescription{0.4, both, white});
  scene.shapes[1].bsdf = add_bsdf(scene, TwoSidedDescription{three, three});
  expect_path_tracers_means(scene, IndirectLight::map, "blend");
}

// Flux is over the true area, reflected by the normals that maps show.
TEST(rough_surfaces, under_maps_have_the_path_tracers_means) {
  for (SceneDescription scene : {test::bumped_mesh(32), test::normal_mapped_mesh(32)}) {
    const std::size_t map = scene.bsdfs.size() - 1;
    const bool bumps = std::holds_alternative<BumpMapDescription>(scene.bsdfs[map].model);
    scene.bsdfs[map - 1].model = PhongDescription{100.0, RgbD{0.2, 0.5, 0.3}, RgbD(0.4)};
    DielectricDescription glass;
    glass.int_ior = 1.5;
    test::add_shape(scene, SphereDescription{{0.3, -0.3, -0.3}, 0.4}, {}, add_bsdf(scene, glass));
    expect_path_tracers_means(scene, IndirectLight::map, bumps ? "bumps" : "normals that lean");
  }
}

TEST(rough_surfaces, the_same_bits_by_any_number_of_threads_and_instruction_sets) {
  for (const Material& material : {materials()[3], materials()[1]}) {
    const SceneDescription scene = test::with_indirect(rough_room(material.model, 24), IndirectLight::map);
    const auto out = test::expect_same_bits_at_any_threads(scene, "photonmapper", job_with(8, 20'000));
    EXPECT_GT(out.stats.counts.at("photons_stored_caustic"), 0);
    test::expect_instruction_sets_agree(scene, "photonmapper", job_with(8, 20'000));
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
