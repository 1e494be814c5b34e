// From descriptions of BSDFs to records: slots that textures write, and refused parameters.

#include "renderer/bsdfs/compile_bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "renderer/bsdfs/test_bsdfs.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

constexpr TextureIndex texture{7};

CompiledBsdf compile(const decltype(BsdfDescription::model)& model,
                     const decltype(BsdfDescription::model)& base = DiffuseDescription{}) {
  SceneDescription scene;
  scene.files = {"test.xml"};
  scene.bsdfs.push_back({{}, "", base});
  scene.bsdfs.push_back({{}, "", model});
  return compile_bsdf(scene, {1});
}

/// The record with this value written into the words of its only slot.
template <class Record>
Record with_texture(const CompiledBsdf& compiled, bool is_colour) {
  EXPECT_EQ(compiled.slots.size(), 1u);
  Record record = std::get<Record>(compiled.record);
  const TextureSlot& slot = compiled.slots.at(0);
  EXPECT_EQ(slot.texture, texture.value);
  EXPECT_EQ(slot.is_colour, is_colour);
  const float values[] = {0.25f, 0.125f, 0.0625f};
  std::memcpy(reinterpret_cast<char*>(&record) + slot.word * sizeof(float), values,
              (is_colour ? 3 : 1) * sizeof(float));
  return record;
}
const Rgb written(0.25f, 0.125f, 0.0625f);

TEST(compile_bsdf, textures_write_where_their_parameters_are) {
  using Facets = MicrofacetDistribution;
  EXPECT_EQ(with_texture<DiffuseBsdf<float>>(compile(DiffuseDescription{texture}), true).reflectance, written);
  EXPECT_EQ(
      with_texture<DiffuseTransmitterBsdf<float>>(compile(DiffuseTransmitterDescription{texture}), true).transmittance,
      written);
  const RgbD one(1.0);
  EXPECT_EQ(
      with_texture<DielectricBsdf<float>>(compile(DielectricDescription{1.5, 1.0, one, texture}), true).transmittance,
      written);
  EXPECT_EQ(with_texture<PlasticBsdf<float>>(compile(PlasticDescription{texture, one, 1.5, 1.0, false}), true).diffuse,
            written);
  EXPECT_EQ(with_texture<PlasticBsdf<float>>(compile(PlasticDescription{one, texture, 1.5, 1.0, false}), true).specular,
            written);
  EXPECT_EQ(with_texture<RoughConductorBsdf<float>>(
                compile(RoughConductorDescription{Facets::ggx, 0.1, texture, true, {}, one}), false)
                .facets.raw_alpha_v,
            0.25f);
  EXPECT_EQ(with_texture<RoughDielectricBsdf<float>>(
                compile(RoughDielectricDescription{Facets::ggx, texture, 0.1, true, 1.5, 1.0, one, one}), false)
                .facets.raw_alpha_u,
            0.25f);
  EXPECT_EQ(with_texture<PhongBsdf<float>>(compile(PhongDescription{texture, one, one}), false).raw_exponent, 0.25f);
  // A lacquer's base is first in its record, so its slots stay.
  EXPECT_EQ(
      with_texture<LayeredPhongBsdf<float>>(
          compile(LayeredDescription{{0}, 1.5, 1.0, RgbD(0.0), 1, one}, PhongDescription{10.0, one, texture}), true)
          .base.raw_specular,
      written);
  EXPECT_EQ(with_texture<LayeredDiffuseBsdf<float>>(
                compile(LayeredDescription{{0}, 1.5, 1.0, RgbD(0.0), 1, texture}, DiffuseDescription{one}), true)
                .specular,
            written);
}

TEST(compile_bsdf, principled_glass_is_a_kind_of_its_own) {
  const auto compiled = [](const PrincipledDescription& d) { return compile(d).record; };
  EXPECT_FALSE(lets_light_through(compiled({})));
  EXPECT_FALSE(lets_light_through(compiled({.metallic = 1.0})));
  EXPECT_TRUE(lets_light_through(compiled({.spec_trans = 0.1})));
  EXPECT_TRUE(lets_light_through(compiled({.spec_trans = texture})));
  // R0 = 0.08 x 0.5 is (0.5 / 2.5)^2.
  EXPECT_NEAR(std::get<PrincipledBsdf<float>>(compiled({})).eta, 1.5, 1e-6);
  // Mitsuba's values in place of those that glass cannot have.
  const auto eta_of = [&](const PrincipledDescription& d) {
    return std::get<PrincipledGlassBsdf<float>>(compiled(d)).eta;
  };
  EXPECT_EQ(eta_of({.spec_trans = 0.1, .eta = 1.0}), 1.001f);
  EXPECT_NEAR(eta_of({.spec_trans = 0.1, .specular = 0}), 2 / (1 - std::sqrt(8e-5)) - 1, 1e-6);
  EXPECT_EQ(std::get<PrincipledBsdf<float>>(compiled({.eta = 1.0})).eta, 1.0f);
  EXPECT_THROW(compiled({.spec_trans = 0.1, .eta = 1 + 1e-9}), InputError);
}

TEST(compile_bsdf, refuses_what_has_no_record) {
  const RgbD one(1.0);
  EXPECT_THROW(compile(RoughDielectricDescription{MicrofacetDistribution::ggx, 0.1, 0.1, true, 1.3, 1.3, one, one}),
               InputError);
  EXPECT_THROW(compile(RoughPlasticDescription{MicrofacetDistribution::ggx, 0.1, true, one, one, 1.3, 1.3, false}),
               InputError);
  EXPECT_THROW(compile(TwoSidedDescription{{0}, {0}}), InputError);
  EXPECT_THROW(
      compile(LayeredDescription{{0}, 1.5, 1.0, RgbD(0.0), 1, one}, PlasticDescription{one, one, 1.5, 1, false}),
      InputError);
  // Smooth interfaces accept equal indices.
  EXPECT_NO_THROW(compile(DielectricDescription{1.3, 1.3, one, one}));
}

TEST(compile_bsdf, knows_what_is_anisotropic_under_a_lacquer_too) {
  SceneDescription scene;
  const RgbD one(1.0);
  scene.bsdfs.push_back({{}, "", RoughConductorDescription{MicrofacetDistribution::ggx, 0.1, 0.2, true, {}, one}});
  scene.bsdfs.push_back({{}, "", LayeredDescription{{0}, 1.5, 1.0, RgbD(0.0), 1, one}});
  scene.bsdfs.push_back({{}, "", PlasticDescription{}});
  scene.bsdfs.push_back({{}, "", PrincipledDescription{.anisotropic = 0.1}});
  scene.bsdfs.push_back({{}, "", PrincipledDescription{}});
  scene.bsdfs.push_back({{}, "", PrincipledThinDescription{.anisotropic = texture}});
  EXPECT_TRUE(is_anisotropic(scene, {3}));
  EXPECT_FALSE(is_anisotropic(scene, {4}));
  EXPECT_TRUE(is_anisotropic(scene, {5}));
  EXPECT_TRUE(is_anisotropic(scene, {0}));
  EXPECT_TRUE(is_anisotropic(scene, {1}));
  EXPECT_FALSE(is_anisotropic(scene, {2}));
}

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
