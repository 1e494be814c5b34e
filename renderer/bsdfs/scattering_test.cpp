// Light paths and camera paths transport the same light from a light to a camera. Checked for every kind of BSDF with
// normals interpolated, mapped, mirrored, shadowed and nested.

#include "renderer/bsdfs/scattering.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

TextureIndex even(SceneDescription& d, const Rgb& rgb) {
  auto image = std::make_shared<Image>(1, 1);
  for (int c = 0; c < 3; ++c) image->pixel(0, 0)[c] = c == 0 ? rgb.x : c == 1 ? rgb.y : rgb.z;
  d.textures.push_back({{}, "", BitmapDescription{"", image, true, TextureFilter::bilinear, TextureWrap::repeat, {}}});
  return {static_cast<std::uint32_t>(d.textures.size() - 1)};
}
/// A normal map with the constant normal n.
BsdfIndex mapped(SceneDescription& d, const Vec3f& n, BsdfIndex nested, MappedNormalsDescription options) {
  const TextureIndex texture = even(d, (normalize(n) + Vec3f(1.0f)) * 0.5f);
  return test::add_bsdf(d, NormalMapDescription{texture, nested, options});
}

enum class Normals { face, leaning, mapped, plainly_mapped, mapped_in_twosided, plain_in_twosided, mapped_twice };

/// A large triangle at z = 0 with this BSDF and normals of this kind.
SceneDescription surface(const decltype(BsdfDescription::model)& model, Normals normals) {
  SceneDescription d;
  BsdfIndex bsdf = test::add_bsdf(d, model);
  const Vec3f lean(0.7f, -0.3f, 0.65f);
  if (normals == Normals::mapped) bsdf = mapped(d, lean, bsdf, {true, true});
  if (normals == Normals::plainly_mapped) bsdf = mapped(d, lean, bsdf, {false, false});
  if (normals == Normals::mapped_in_twosided || normals == Normals::plain_in_twosided) {
    const bool options = normals == Normals::mapped_in_twosided;
    bsdf = mapped(d, lean, bsdf, {options, options});
    bsdf = test::add_bsdf(d, TwoSidedDescription{bsdf, bsdf});
  }
  if (normals == Normals::mapped_twice)
    bsdf = mapped(d, {-0.2f, 0.5f, 0.8f}, mapped(d, lean, bsdf, {true, true}), {true, true});
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(3);
  mesh->positions[0] = {-10, -10, 0};
  mesh->positions[1] = {10, -10, 0};
  mesh->positions[2] = {0, 10, 0};
  mesh->triangles = {{0, 1, 2}};
  if (normals != Normals::face) mesh->normals.assign(3, normalize(Vec3f(-0.4f, 0.3f, 0.8f)));
  test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "", false, false, mesh}, {}, bsdf);
  test::set_camera(d, Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 25, 4);
  return d;
}

/// Radiance of a light and sensitivity of a camera that are far away in all directions.
float light(const Vec3f& to_light) { return 1 + 0.8f * to_light.x - 0.5f * to_light.z * to_light.y; }
float camera(const Vec3f& to_camera) { return 1 - 0.6f * to_camera.y + 0.7f * to_camera.x * to_camera.z; }

class OneSurface {
 public:
  explicit OneSurface(const SceneDescription& description)
      : scene_(test::compiled(description, 4, 4)), world_(scene_) {}
  const SceneInterface& scene() const { return world_; }
  Interaction met_from(const Vec3f& direction, float u, TransportMode mode) const {
    Interaction at;
    EXPECT_TRUE(world_.intersect({direction * 3.0f, -direction}, u, mode, at));
    return at;
  }

 private:
  Scene scene_;
  SceneInterface world_;
};

struct Mean {
  double value, error;
};
/// The integral int int camera(o) |o.ng| K(o,i) light(i) di do, by paths of that mode over randomly shifted lattices.
/// Their spread is the error. Steps are powers of the root of x^7 = x + 1, which fill the six dimensions evenly.
Mean transported(const OneSurface& surface, TransportMode mode) {
  constexpr int lattices = 24, points = 4000;
  double sum = 0, squares = 0;
  for (std::uint64_t k = 0; k < lattices; ++k) {
    test::Random random(77, k);
    std::array<double, 6> step{}, shift{};
    for (std::size_t axis = 0; axis < step.size(); ++axis) {
      step[axis] = std::pow(1.1127756842787055, -1.0 - static_cast<double>(axis));
      shift[axis] = double{random.next()};
    }
    double mean = 0;
    for (int i = 0; i < points; ++i) {
      const auto u = [&](std::size_t axis) {
        const double x = shift[axis] + i * step[axis];
        return std::min(static_cast<float>(x - std::floor(x)), 1 - 0x1p-24f);
      };
      const Vec3f wo = square_to_sphere<float>({u(0), u(1)});
      if (std::abs(wo.z) < 1e-4f) continue;
      const Interaction at = surface.met_from(wo, u(2), mode);
      const Scattered s = scatter(at, wo, u(3), {u(4), u(5)}, mode);
      if (!s.valid) continue;
      const bool from_camera = mode == TransportMode::radiance;
      const float ends = from_camera ? camera(wo) * light(s.wi) : camera(s.wi) * light(wo);
      mean += 4 * std::numbers::pi * double{ends * cosine(at.ng, wo) * s.weight.y} / points;
    }
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / lattices;
  return {mean, std::sqrt(std::max(0.0, squares / lattices - mean * mean) / (lattices - 1))};
}

struct Material {
  const char* name;
  decltype(BsdfDescription::model) model;
  bool transmits;
};
std::vector<Material> materials() {
  const RgbD one(1.0);
  return {{"diffuse", DiffuseDescription{RgbD(0.8)}, false},
          {"conductor", ConductorDescription{}, false},
          {"roughconductor", RoughConductorDescription{MicrofacetDistribution::ggx, 0.3, 0.3, true, {}, one}, false},
          {"plastic", PlasticDescription{RgbD(0.7), one, 1.5, 1.0, false}, false},
          {"phong", PhongDescription{20.0, RgbD(0.4), RgbD(0.5)}, false},
          {"dielectric", DielectricDescription{1.5, 1.0, one, one, {}}, true},
          {"roughdielectric",
           RoughDielectricDescription{MicrofacetDistribution::ggx, 0.4, 0.4, true, 1.5, 1.0, one, one}, true},
          {"principled", PrincipledDescription{.base_color = RgbD(0.7), .roughness = 0.6}, false},
          {"principled glass", PrincipledDescription{.roughness = 0.7, .spec_trans = 0.7, .eta = 1.4}, true},
          {"principledthin",
           PrincipledThinDescription{.base_color = RgbD(0.7), .roughness = 0.8, .spec_trans = 0.6, .diff_trans = 0.8},
           true}};
}

bool in_twosided(Normals n) { return n == Normals::mapped_in_twosided || n == Normals::plain_in_twosided; }

class BothModes : public testing::TestWithParam<Normals> {};

TEST_P(BothModes, carry_the_same_light_from_a_light_to_a_camera) {
  // A missing or wrong cosine is at least 10 % off; a map state drawn with a probability other than declared 5 %.
  // Standard errors are 0.1 to 1 %, and 2 % under two maps.
  for (const Material& m : materials()) {
    if (m.transmits && in_twosided(GetParam())) continue;
    const OneSurface one(surface(m.model, GetParam()));
    const Mean by_camera = transported(one, TransportMode::radiance);
    const Mean by_light = transported(one, TransportMode::importance);
    const double error = std::hypot(by_camera.error, by_light.error);
    std::printf("%s: %.5g from the camera, %.5g from the light, standard error %.2g\n", m.name, by_camera.value,
                by_light.value, error);
    EXPECT_NEAR(by_light.value, by_camera.value, 4 * error + 1e-4 * by_camera.value) << m.name;
    EXPECT_LT(error, 0.025 * by_camera.value) << m.name;
    EXPECT_GT(by_camera.value, 0) << m.name;
  }
}

TEST_P(BothModes, have_weights_that_are_the_value_over_the_density) {
  // bdpt and the light tracer connect with the values that `scatter` samples: f cos = weight x pdf, to rounding.
  for (const Material& m : materials()) {
    if (m.transmits && in_twosided(GetParam())) continue;
    const OneSurface one(surface(m.model, GetParam()));
    int smooth = 0;
    for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance})
      for (std::uint64_t i = 0; i < 2000; ++i) {
        test::Random random(78, i);
        const Vec3f wo = square_to_sphere<float>(random.next2());
        if (std::abs(wo.z) < 1e-3f) continue;
        const float u_layer = random.next(), u_lobe = random.next();
        const Interaction at = one.met_from(wo, u_layer, mode);
        const Scattered s = scatter(at, wo, u_lobe, random.next2(), mode);
        if (!s.valid || s.delta) continue;
        ++smooth;
        const bool from_camera = mode == TransportMode::radiance;
        const Vec3f to_camera = from_camera ? wo : s.wi, to_light = from_camera ? s.wi : wo;
        if (std::min(std::abs(at.scattering.frame.to_local(s.wi).z), cosine(at.ng, s.wi)) < 0.01f)
          continue;  // rounding
        const float value = evaluate(at, to_camera, to_light, mode).y;
        const float pdf = scatter_pdf(at, wo, s.wi, mode);
        // The pdf of a sample covers all lobes, so its weight is that of their sum.
        ASSERT_NEAR(s.weight.y * s.pdf, value, 2e-3f * value) << m.name << ' ' << i;
        ASSERT_NEAR(s.pdf, pdf, 2e-3f * pdf) << m.name << ' ' << i;
        // The definition: a light path's value is a camera path's, times the ratio of true cosines.
        const float forward = evaluate(at, to_camera, to_light, TransportMode::radiance).y * cosine(at.ng, to_camera);
        const float adjoint = evaluate(at, to_camera, to_light, TransportMode::importance).y * cosine(at.ng, to_light);
        ASSERT_NEAR(forward, adjoint, 1e-3f * forward) << m.name << ' ' << i;
      }
    if (has_smooth(compile_bsdfs(surface(m.model, GetParam())).records[0])) {
      EXPECT_GT(smooth, 500) << m.name;
    }
  }
}

TEST_P(BothModes, agree_on_what_a_map_shows_to_whom) {
  // Light paths leave along o only in a state that is seen along o.
  const OneSurface one(surface(DiffuseDescription{RgbD(0.8)}, GetParam()));
  int others = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    test::Random random(79, i);
    const Vec3f to_light = square_to_sphere<float>(random.next2()), to_camera = square_to_sphere<float>(random.next2());
    if (std::abs(to_light.z) < 1e-3f || std::abs(to_camera.z) < 1e-3f) continue;
    const float u = random.next();
    const Interaction by_light = one.met_from(to_light, u, TransportMode::importance);
    const Interaction by_camera = one.met_from(to_camera, u, TransportMode::radiance);
    Interaction other;
    const Interaction& seen = one.scene().seen_from(by_light, to_camera, other);
    others += &seen == &other ? 1 : 0;
    ASSERT_EQ(evaluate(seen, to_camera, to_light, TransportMode::radiance),
              evaluate(by_camera, to_camera, to_light, TransportMode::radiance));
  }
  if (GetParam() == Normals::mapped || GetParam() == Normals::mapped_in_twosided) {
    EXPECT_GT(others, 400);
  }
}

std::string name_of(const testing::TestParamInfo<Normals>& sort) {
  constexpr const char* names[] = {
      "face", "leaning", "mapped", "plainly_mapped", "mapped_in_twosided", "plain_in_twosided", "mapped_twice"};
  return names[static_cast<int>(sort.param)];
}

INSTANTIATE_TEST_SUITE_P(normals, BothModes,
                         testing::Values(Normals::face, Normals::leaning, Normals::mapped, Normals::plainly_mapped,
                                         Normals::mapped_in_twosided, Normals::plain_in_twosided,
                                         Normals::mapped_twice),
                         name_of);

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
