// Materials, textures and media of pbrt scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/description/named_ior.h"
#include "scenes/images/image.h"
#include "scenes/pbrt/test_pbrt.h"

namespace photonproof::inline scenes_pbrt {
namespace {

class PbrtMaterialsTest : public PbrtTest {
 protected:
  SceneDescription with(const std::string& material) { return world(material + "\nShape \"sphere\""); }
  template <class Model>
  static const Model& model(const SceneDescription& scene, BsdfIndex index) {
    const BsdfDescription* bsdf = &scene.bsdfs.at(index.value);
    if (const auto* both = std::get_if<TwoSidedDescription>(&bsdf->model)) {
      EXPECT_EQ(both->front, both->back);
      bsdf = &scene.bsdfs.at(both->front.value);
    }
    return std::get<Model>(bsdf->model);
  }
  template <class Model>
  const Model& model(const SceneDescription& scene) {
    return model<Model>(scene, scene.shapes.at(0).bsdf);
  }
  void put_image(const std::string& name, const RgbD& left, const RgbD& right) const {
    Rendering image;
    image.mean = Image(2, 1);
    for (const auto& [x, c] : {std::pair(0, left), std::pair(1, right)}) {
      image.mean.pixel(x, 0)[0] = static_cast<float>(c.x);
      image.mean.pixel(x, 0)[1] = static_cast<float>(c.y);
      image.mean.pixel(x, 0)[2] = static_cast<float>(c.z);
    }
    write_exr((folder_ / name).string(), image);
  }
  static const BitmapDescription& bitmap(const SceneDescription& scene, std::size_t index) {
    return std::get<BitmapDescription>(scene.textures.at(index).pattern);
  }
};

TEST_F(PbrtMaterialsTest, diffuse_reflects_on_both_sides) {
  EXPECT_EQ(constant(model<DiffuseDescription>(with("")).reflectance), RgbD(0.5));
  const SceneDescription scene = with("Material \"diffuse\" \"rgb reflectance\" [ .1 .2 .3 ]");
  EXPECT_EQ(constant(model<DiffuseDescription>(scene).reflectance), RgbD(.1, .2, .3));
  EXPECT_TRUE(std::holds_alternative<TwoSidedDescription>(scene.bsdfs.at(scene.shapes[0].bsdf.value).model));
}

TEST_F(PbrtMaterialsTest, alpha_is_the_root_of_a_remapped_roughness) {
  const auto alpha = [&](const std::string& parameters) {
    const SceneDescription scene = with("Material \"dielectric\" " + parameters);
    const auto& glass = std::get<RoughDielectricDescription>(scene.bsdfs.at(scene.shapes[0].bsdf.value).model);
    EXPECT_EQ(glass.distribution, MicrofacetDistribution::ggx);
    return std::pair(std::get<double>(glass.alpha_u), std::get<double>(glass.alpha_v));
  };
  EXPECT_EQ(alpha("\"float roughness\" .25"), std::pair(.5, .5));
  EXPECT_EQ(alpha("\"float roughness\" .25 \"bool remaproughness\" false"), std::pair(.25, .25));
  EXPECT_EQ(alpha("\"float uroughness\" .25 \"float vroughness\" .04"), std::pair(.5, .2));
  const SceneDescription smooth = with("Material \"dielectric\" \"float eta\" 1.3");
  EXPECT_EQ(std::get<DielectricDescription>(smooth.bsdfs.at(smooth.shapes[0].bsdf.value).model).int_ior, 1.3);
  EXPECT_EQ(std::get<DielectricDescription>(smooth.bsdfs.at(smooth.shapes[0].bsdf.value).model).ext_ior, 1);
}

TEST_F(PbrtMaterialsTest, metals_are_named_or_have_a_reflectance) {
  EXPECT_EQ(model<ConductorDescription>(with("Material \"conductor\"")).ior, conductor_named("Cu"));
  const SceneDescription gold = with(
      "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float roughness\" .01");
  EXPECT_EQ(model<RoughConductorDescription>(gold).ior, conductor_named("Au"));
  // At normal incidence ((eta-1)^2 + k^2) / ((eta+1)^2 + k^2) is the reflectance.
  const auto ior = model<ConductorDescription>(with("Material \"conductor\" \"rgb reflectance\" [ .9 .5 .1 ]")).ior;
  const auto fresnel = [](double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  EXPECT_NEAR(fresnel(ior->eta.x, ior->k.x), .9, 1e-9);
  EXPECT_NEAR(fresnel(ior->eta.z, ior->k.z), .1, 1e-9);
}

TEST_F(PbrtMaterialsTest, coats_are_plastic_and_lacquer) {
  EXPECT_TRUE(model<PlasticDescription>(with("Material \"coateddiffuse\"")).nonlinear);
  const SceneDescription rough = with("Material \"coateddiffuse\" \"float roughness\" .04 \"float eta\" 1.6");
  EXPECT_NEAR(model<RoughPlasticDescription>(rough).alpha, .2, 1e-12);
  EXPECT_EQ(model<RoughPlasticDescription>(rough).int_ior, 1.6);
  const SceneDescription metal =
      with("Material \"coatedconductor\" \"float conductor.roughness\" .09 \"float interface.eta\" 1.4");
  const auto& layered = model<LayeredDescription>(metal);
  EXPECT_EQ(layered.int_ior, 1.4);
  EXPECT_NEAR(std::get<double>(model<RoughConductorDescription>(metal, layered.base).alpha_u), .3, 1e-12);
}

TEST_F(PbrtMaterialsTest, a_sheet_keeps_its_reflectance_and_transmittance) {
  const SceneDescription scene =
      with("Material \"diffusetransmission\" \"rgb reflectance\" [ .6 .3 0 ] \"rgb transmittance\" [ .2 .1 .2 ]");
  const auto& blend = std::get<BlendDescription>(scene.bsdfs.at(scene.shapes[0].bsdf.value).model);
  const double weight = std::get<double>(blend.weight);
  const RgbD reflected = constant(model<DiffuseDescription>(scene, blend.first).reflectance) * (1 - weight);
  const RgbD passed = constant(model<DiffuseTransmitterDescription>(scene, blend.second).transmittance) * weight;
  EXPECT_NEAR(length(reflected - RgbD(.6, .3, 0)), 0, 1e-12);
  EXPECT_NEAR(length(passed - RgbD(.2, .1, .2)), 0, 1e-12);
}

TEST_F(PbrtMaterialsTest, named_materials_mix_and_attributes_are_defaults) {
  const SceneDescription scene = world(
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [ .1 .1 .1 ]\n"
      "MakeNamedMaterial \"b\" \"string type\" \"interface\"\n"
      "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [ \"a\" \"b\" ] \"float amount\" .3\n"
      "AttributeBegin NamedMaterial \"m\" Attribute \"shape\" \"float radius\" 7 Shape \"sphere\" AttributeEnd\n"
      "Shape \"sphere\"");
  const auto& blend = std::get<BlendDescription>(scene.bsdfs.at(scene.shapes[0].bsdf.value).model);
  EXPECT_EQ(std::get<double>(blend.weight), .3);
  EXPECT_EQ(constant(model<DiffuseDescription>(scene, blend.first).reflectance), RgbD(.1));
  EXPECT_TRUE(std::holds_alternative<NullDescription>(scene.bsdfs.at(blend.second.value).model));
  EXPECT_EQ(std::get<SphereDescription>(scene.shapes[0].geometry).radius, 7);
  EXPECT_EQ(std::get<SphereDescription>(scene.shapes[1].geometry).radius, 1);
  EXPECT_EQ(constant(model<DiffuseDescription>(scene, scene.shapes[1].bsdf).reflectance), RgbD(.5));
}

TEST_F(PbrtMaterialsTest, images_lie_as_pbrt_looks_them_up) {
  put_image("a.exr", RgbD(.2), RgbD(.8));
  const SceneDescription scene = with(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.exr\" \"float vscale\" 2 \"float vdelta\" .25 "
      "\"float uscale\" 3 \"float udelta\" .5 \"string wrap\" \"clamp\"\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\"");
  const BitmapDescription& image = bitmap(scene, 0);
  // At (u, v) = (.1, .3) pbrt looks up (3 * .1 + .5, 2 * .3 + .25), and rows from above at 1 - .85. Our v is 1 - .3.
  EXPECT_NEAR(length(image.to_uv.point({.1, .7, 0}) - Vec3d(.8, .15, 0)), 0, 1e-12);
  EXPECT_EQ(image.wrap, TextureWrap::clamp);
}

TEST_F(PbrtMaterialsTest, images_are_scaled_inverted_and_limited_to_1) {
  put_image("a.exr", RgbD(.2, .6, 3), RgbD(0, 1, .5));
  const SceneDescription scene = with(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.exr\" \"float scale\" .5 \"bool invert\" true\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\"");
  const Image made = read_image((folder_ / "made" / bitmap(scene, 0).filename).string());
  const float expected[] = {.9f, .7f, 0, 1, .5f, .75f};  // 1 - half of it, at least 0
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(made.rgb[i], expected[i], 1e-6) << i;
  const SceneDescription bright = with(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.exr\"\n"
      "Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"t\" \"float scale\" .75\n"
      "Material \"diffuse\" \"texture reflectance\" \"s\"");
  const Image clamped = read_image((folder_ / "made" / bitmap(bright, 0).filename).string());
  const float products[] = {.15f, .45f, 1, 0, .75f, .375f};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(clamped.rgb[i], products[i], 1e-6) << i;
}

TEST_F(PbrtMaterialsTest, roughness_of_an_image_is_remapped_texel_by_texel) {
  put_image("a.exr", RgbD(.25), RgbD(.04));
  const SceneDescription scene = with(
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"a.exr\"\n"
      "Material \"conductor\" \"texture roughness\" \"t\"");
  const auto index = std::get<TextureIndex>(model<RoughConductorDescription>(scene).alpha_u);
  const Image made = read_image((folder_ / "made" / bitmap(scene, index.value).filename).string());
  EXPECT_NEAR(made.rgb[0], .5, 1e-6);
  EXPECT_NEAR(made.rgb[3], .2, 1e-6);
}

TEST_F(PbrtMaterialsTest, checkerboards_have_squares_of_one_unit) {
  const SceneDescription scene = with(
      "Texture \"t\" \"spectrum\" \"checkerboard\" \"float uscale\" 4 \"rgb tex1\" [ .9 .9 .9 ] \"rgb tex2\" [ .1 .1 "
      ".1 ]\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\"");
  const auto& board = std::get<CheckerboardDescription>(scene.textures.at(0).pattern);
  EXPECT_EQ(constant(board.color0), RgbD(.9)) << "the square at (0, 0)";
  // pbrt's (4 u, v), in halves; our v is 1 - v.
  EXPECT_NEAR(length(board.to_uv.point({.25, .4, 0}) - Vec3d(.5, .3, 0)), 0, 1e-12);
}

TEST_F(PbrtMaterialsTest, alpha_is_a_mask) {
  const SceneDescription scene = world("Shape \"sphere\" \"float alpha\" .4");
  const auto& mask = std::get<MaskDescription>(scene.bsdfs.at(scene.shapes[0].bsdf.value).model);
  EXPECT_EQ(std::get<double>(mask.opacity), .4);
}

TEST_F(PbrtMaterialsTest, media_lie_behind_and_before_surfaces) {
  const SceneDescription scene = read(
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 1 0 0 ] \"rgb sigma_s\" [ 3 2 0 ] "
      "\"float scale\" 2 \"float g\" .5\n"
      "MediumInterface \"\" \"fog\" Camera \"perspective\" WorldBegin\n"
      "MediumInterface \"fog\" \"\" Material \"interface\" Shape \"sphere\"");
  const auto& fog = std::get<HomogeneousDescription>(scene.media.at(0).model);
  EXPECT_EQ(fog.sigma_t, RgbD(8, 4, 0));
  EXPECT_EQ(fog.albedo, VolumeColour(RgbD(.75, 1, 0)));
  EXPECT_EQ(std::get<HenyeyGreensteinDescription>(fog.phase).g, .5);
  EXPECT_TRUE(scene.shapes[0].interior.has_value());
  EXPECT_FALSE(scene.shapes[0].exterior.has_value());
  EXPECT_TRUE(scene.sensor.medium.has_value());
  EXPECT_TRUE(std::holds_alternative<VolPathDescription>(scene.integrator.method));
}

}  // namespace
}  // namespace photonproof::inline scenes_pbrt
