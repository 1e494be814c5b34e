// Laws that hold for every BSDF: energy conservation, reciprocity, weights equal to f cos / pdf and finite numbers.
// Rough models converge to the smooth ones.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderer/bsdfs/test_bsdf_records.h"
#include "renderer/bsdfs/test_bsdfs.h"
#include "renderer/bsdfs/test_shading.h"
#include "renderer/lanes/test_random.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

using test::compiled;
using test::NamedBsdf;

bool transmits(const Bsdf& bsdf) { return has_smooth(bsdf) && lets_light_through(bsdf); }

/// Index of refraction behind the surface over that in front of it.
float index_behind(const Bsdf& bsdf) {
  if (const auto* glass = std::get_if<RoughDielectricBsdf<float>>(&bsdf)) return glass->eta;
  if (const auto* glass = std::get_if<PrincipledGlassBsdf<float>>(&bsdf)) return glass->eta;
  return 1;
}

/// Whether Mitsuba's rule about the backs of facets ends a thin principled BSDF's glass for one order of the directions
/// only (bsdf_principledthin.h).
bool breaks_symmetry(const Bsdf& bsdf, const Vec3f& a, const Vec3f& b) {
  if (!std::holds_alternative<PrincipledThinBsdf<float>>(bsdf) || a.z * b.z > 0) return false;
  const Vec3f m = half_vector(a, Vec3f(b.x, b.y, -b.z));
  return (dot(m, b) < 0) != (dot(Vec3f(m.x, m.y, -m.z), a) < 0);
}

/// Whether a principled BSDF has Burley's base. Its highlight dims it by no more than a falloff of its own, so the sum
/// may exceed 1, as in Mitsuba.
bool has_burleys_base(const std::string& name) {
  return name.find("principled") != std::string::npos && !name.starts_with("principled metal") &&
         !name.starts_with("principled glass") && !name.starts_with("principledthin glass");
}

/// All materials except those whose facets are sampled by area: their weights have no bound.
std::vector<NamedBsdf> furnace_bsdfs() {
  std::vector<NamedBsdf> all;
  for (const NamedBsdf& named : test::white_bsdfs({1e-4, 0.1, 0.5, 1.0}))
    if (named.name.find("by area") == std::string::npos && !has_burleys_base(named.name)) all.push_back(named);
  return all;
}

struct Mean {
  double value = 0, error = 0;
};
/// Reflected and transmitted flux in a white furnace, by sampling; brightest channel.
Mean albedo(const Bsdf& bsdf, const Vec3f& wo, int samples) {
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    test::Random random(31, static_cast<std::uint64_t>(i));
    const float u_lobe = random.next();
    const auto drawn = test::sample(bsdf, wo, u_lobe, random.next2(), TransportMode::importance);
    const double w = drawn ? static_cast<double>(max_component(drawn->weight)) : 0;
    sum += w;
    squares += w * w;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

/// The same albedo over 16 randomly shifted lattices; their spread is the error. For smooth materials that error is a
/// tenth of the one above at the same cost. Steps are powers of the root of x^4 = x + 1, which fill the cube evenly.
Mean albedo_on_lattices(const Bsdf& bsdf, const Vec3f& wo, int points) {
  constexpr int lattices = 16;
  const std::array<double, 3> steps{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  double sum = 0, squares = 0;
  for (std::uint64_t k = 0; k < lattices; ++k) {
    test::Random random(35, k);
    const std::array<double, 3> shift{random.next(), random.next(), random.next()};
    double mean = 0;
    for (int i = 0; i < points; ++i) {
      const auto coordinate = [&](std::size_t axis) {
        const double x = shift[axis] + i * steps[axis];
        return std::min(static_cast<float>(x - std::floor(x)), 1 - 0x1p-24f);
      };
      const auto drawn =
          test::sample(bsdf, wo, coordinate(0), {coordinate(1), coordinate(2)}, TransportMode::importance);
      mean += drawn ? static_cast<double>(max_component(drawn->weight)) / points : 0;
    }
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / lattices;
  return {mean, std::sqrt(std::max(0.0, squares / lattices - mean * mean) / (lattices - 1))};
}

/// The properties of Lambertian kinds that photon maps and gathers rely on.
template <class Kind>
void expect_lambertian() {
  test::Random random(17);
  Kind bsdf{};
  test::randomise(bsdf, random);
  const Rgb in_front = bsdf.eval(Vec3f(0, 0, 1), Vec3f(0.6f, 0, 0.8f));
  EXPECT_GT(max_component(in_front), 0);
  for (const Vec3f& wo : test::test_directions(true))
    for (const Vec3f& wi : test::test_directions(true))
      EXPECT_EQ(bsdf.eval(wo, wi), wo.z > 0 && wi.z > 0 ? in_front : Rgb(0.0f)) << wo.z << ' ' << wi.z;
}

template <class... Kinds>
void expect_lambertian_where_they_say_so(const std::variant<Kinds...>*) {
  const auto look_at = []<class Kind>(const Kind*) {
    if constexpr (Kind::is_lambertian) expect_lambertian<Kind>();
  };
  (look_at(static_cast<const Kinds*>(nullptr)), ...);
}

TEST(bsdf_laws, lambertian_ones_are_the_same_in_front_and_black_behind) {
  expect_lambertian_where_they_say_so(static_cast<const Bsdf*>(nullptr));
}

/// Whether some sample of records of the kind, seen from both sides, leaves on the other side.
template <class Kind>
bool scatters_behind() {
  test::Random random(19);
  bool behind = false;
  for (int record = 0; record < 50; ++record) {
    Kind kind{};
    test::randomise(kind, random);
    const Bsdf bsdf = kind;
    for (const Vec3f& wo : test::test_directions(true))
      for (int i = 0; i < 20; ++i) {
        const float u_lobe = random.next();
        const auto drawn = test::sample(bsdf, wo, u_lobe, random.next2(), TransportMode::importance);
        behind = behind || (drawn && drawn->wi_local.z * wo.z < 0);
      }
  }
  return behind;
}

TEST(bsdf_laws, light_comes_out_behind_those_that_say_so_alone) {
  BsdfKinds::for_each([]<template <class> class Kind>(std::uint32_t kind) {
    EXPECT_EQ(scatters_behind<Kind<float>>(), Kind<float>::lets_light_through) << "BSDF " << kind;
  });
}

TEST(bsdf_laws, nothing_makes_energy) {
  // The limit holds even for Beckmann facets with Walter's approximate shadowing, which may exceed the exact one by
  // 0.35 %. Where it does, the shadowing of the other direction loses more than that.
  for (const NamedBsdf& named : furnace_bsdfs())
    for (const Vec3f& wo : test::test_directions(transmits(named.bsdf))) {
      const Mean a = albedo_on_lattices(named.bsdf, wo, 4000);
      EXPECT_LE(a.value, 1 + 1e-3 + 4 * a.error) << named.name << " from " << wo.z;
    }
}

/// Checks, for a kind with a rough part, how eval is split into its parts.
template <class Kind>
void expect_parts_of_eval(const Kind& bsdf, const RoughLimit& limit, const std::string& name) {
  if constexpr (CanBeRough<Kind, float>) {
    for (const Vec3f& wo : test::test_directions(false))
      for (const Vec3f& wi : test::test_directions(false)) {
        const Rgb share = bsdf.rough_share(limit, wo, wi);
        const Rgb rough = RoughPart<Kind, float>{bsdf, limit, false}.eval(wo, wi), f = bsdf.eval(wo, wi);
        for (const auto channel : {&Rgb::x, &Rgb::y, &Rgb::z}) {
          EXPECT_TRUE(share.*channel >= 0 && share.*channel <= 1) << name << ' ' << share.*channel;
          EXPECT_LE(rough.*channel, f.*channel) << name;
        }
        if (!bsdf.is_rough(limit)) {
          EXPECT_EQ(max_component(share), 0) << name;
        }
        // In the mean the decision leaves f of each part, whatever the weights; the probabilities are q and 1 - q.
        const double q = (double{share.x} + double{share.y} + double{share.z}) / 3;
        Rgb of_rough(1.0f), of_rest(1.0f);
        const bool first = is_by_rough_part<float>(share, 0.0f, of_rough);
        const bool last = is_by_rough_part<float>(share, 1 - 0x1p-24f, of_rest);
        EXPECT_EQ(first, q > 0) << name;
        if (first) {
          EXPECT_NEAR(q * double{of_rough.x}, double{share.x}, 1e-5) << name;
        }
        if (!last) {
          EXPECT_NEAR((1 - q) * double{of_rest.x}, 1 - double{share.x}, 1e-5) << name;
        }
      }
  }
}

TEST(bsdf_laws, rough_part_and_rest_are_all_of_it) {
  for (const RoughLimit& limit : {RoughLimit{}, rough_limit_of_points})
    for (const NamedBsdf& named : test::white_bsdfs({0.01, 0.1, 0.3, 1.0}))
      std::visit([&](const auto& bsdf) { expect_parts_of_eval(bsdf, limit, named.name); }, named.bsdf);
}

// The rough part of a coated base has no narrow lobe. It changes by at most a factor of 1.6 as one direction turns by a
// degree.
TEST(bsdf_laws, rough_parts_are_wide) {
  for (const NamedBsdf& named : test::white_bsdfs({0.01, 0.1, 0.3, 1.0})) {
    if (named.name.find("eta 0.66") != std::string::npos) continue;  // nothing crosses it beyond the critical angle
    std::visit(
        [&](const auto& bsdf) {
          using Kind = std::remove_cvref_t<decltype(bsdf)>;
          if constexpr (CanBeRough<Kind, float>) {
            const RoughPart<Kind, float> part{bsdf, RoughLimit{}, false};
            for (double degrees = 5; degrees < 60; degrees += 1) {
              const Vec3f wo = test::slanted(40), mirror(-wo.x, -wo.y, wo.z);
              const auto at = [&](double angle) {
                const Vec3f side = normalize(cross(mirror, Vec3f(0, 0, 1)));
                const auto t = static_cast<float>(angle * std::numbers::pi / 180);
                return normalize(mirror * std::cos(t) + cross(side, mirror) * std::sin(t));
              };
              const float here = max_component(part.eval(wo, at(degrees - 35)));
              const float there = max_component(part.eval(wo, at(degrees - 34)));
              EXPECT_LE(here, 1.6f * there + 1e-6f) << named.name << ' ' << degrees;
              EXPECT_LE(there, 1.6f * here + 1e-6f) << named.name << ' ' << degrees;
            }
          }
        },
        named.bsdf);
  }
}

TEST(bsdf_laws, weights_are_eval_times_cosine_over_density) {
  // Each sample's weight, where the density has enough digits: single precision keeps few for facets 1e-4 wide.
  for (const double alpha : {0.05, 0.3, 1.0})
    for (const NamedBsdf& named : test::white_bsdfs({alpha}))
      for (const Vec3f& wo : test::test_directions(transmits(named.bsdf)))
        for (std::uint64_t i = 0; i < 500; ++i) {
          test::Random random(32, i);
          const float u_lobe = random.next();
          const auto drawn = test::sample(named.bsdf, wo, u_lobe, random.next2(), TransportMode::radiance);
          if (!drawn || drawn->delta) continue;
          const Vec3f& wi = drawn->wi_local;
          const Rgb f = test::eval(named.bsdf, wo, wi) * std::abs(wi.z);
          const float density = test::pdf(named.bsdf, wo, wi), tolerance = std::abs(wi.z) < 0.02f ? 0.03f : 0.01f;
          EXPECT_NEAR(density / drawn->pdf, 1, tolerance) << named.name << " " << wo.z << " " << wi.z;
          EXPECT_NEAR(max_component(f) / drawn->pdf, max_component(drawn->weight),
                      tolerance * max_component(drawn->weight))
              << named.name << " " << wo.z << " " << wi.z;
        }
}

TEST(bsdf_laws, directions_may_be_swapped) {
  // Helmholtz: f(a, b) = f(b, a) on one side; through an interface f(a, b) / eta_b^2 = f(b, a) / eta_a^2 (Veach 1997,
  // section 5.2.2).
  for (const NamedBsdf& named : test::white_bsdfs({0.1, 0.5, 1.0}))
    for (std::uint64_t i = 0; i < 500; ++i) {
      test::Random random(33, i);
      const auto direction = [&](bool up) {
        const float z = 0.05f + 0.95f * random.next(), phi = 6.2831853f * random.next(), r = std::sqrt(1 - z * z);
        return Vec3f(r * std::cos(phi), r * std::sin(phi), up ? z : -z);
      };
      const bool through = transmits(named.bsdf) && i % 2 == 0;
      const Vec3f a = direction(true), b = direction(!through);
      float scale = 1;  // factor that makes the second direction's eval comparable
      if (through) scale = 1 / (index_behind(named.bsdf) * index_behind(named.bsdf));
      if (breaks_symmetry(named.bsdf, a, b)) continue;
      const float forth = max_component(test::eval(named.bsdf, a, b));
      const float back = max_component(test::eval(named.bsdf, b, a)) * scale;
      EXPECT_NEAR(forth, back, 2e-3f * std::max(forth, back) + 1e-6f) << named.name << (through ? " through" : "");
    }
}

TEST(bsdf_laws, numbers_stay_finite_at_the_extremes) {
  // The ends of the unit square, grazing and normal directions, the narrowest and the roughest facets.
  const float last = std::nextafter(1.0f, 0.0f);
  for (const NamedBsdf& named : test::white_bsdfs({0, 1e-4, 1.0}))
    for (const double degrees : {0.0, 1e-3, 45.0, 89.0, 89.99, 89.9999})
      for (const float side : {1.0f, -1.0f})
        for (const float u_lobe : {0.0f, 0.5f, last})
          for (const float x : {0.0f, 0.5f, last})
            for (const float y : {0.0f, 0.25f, 0.5f, last}) {
              const Vec3f wo = test::slanted(degrees) * side;
              const auto drawn = test::sample(named.bsdf, wo, u_lobe, {x, y}, TransportMode::radiance);
              if (!drawn) continue;
              const Vec3f& wi = drawn->wi_local;
              ASSERT_NEAR(length(wi), 1, 1e-3f) << named.name << " " << degrees;
              ASSERT_TRUE(std::isfinite(max_component(drawn->weight)) && drawn->weight.x >= 0)
                  << named.name << " " << degrees << " " << u_lobe << " " << x << " " << y;
              ASSERT_TRUE(drawn->pdf > 0 && !std::isnan(drawn->pdf)) << named.name << " " << degrees;
              const float f = max_component(test::eval(named.bsdf, wo, wi)), p = test::pdf(named.bsdf, wo, wi);
              ASSERT_TRUE(f >= 0 && std::isfinite(f) && p >= 0 && std::isfinite(p)) << named.name << " " << degrees;
            }
}

TEST(bsdf_laws, lossless_ones_lose_nothing) {
  const auto white = [](const Bsdf& bsdf, double degrees) { return albedo(bsdf, test::slanted(degrees), 200'000); };
  const RgbD one(1.0);
  for (const double degrees : {0.0, 50.0, 88.0}) {
    EXPECT_NEAR(white(compiled(DiffuseDescription{one}), degrees).value, 1, 1e-6);
    EXPECT_NEAR(white(compiled(DiffuseTransmitterDescription{one}), degrees).value, 1, 1e-6);
    EXPECT_NEAR(white(compiled(ConductorDescription{{}, one}), degrees).value, 1, 1e-6);
    // At an index of 1000 a base sends its light through the interface 250 million times before it is out.
    for (const double eta : {1.5, 2.4, 100.0, 1000.0}) {
      EXPECT_NEAR(white(compiled(DielectricDescription{eta, 1.0, one, one}), degrees).value, 1, 1e-6);
      EXPECT_NEAR(white(compiled(ThinDielectricDescription{eta, 1.0, one, one}), degrees).value, 1, 1e-6);
      const Mean plastic = white(compiled(PlasticDescription{one, one, eta, 1.0, false}), degrees);
      EXPECT_NEAR(plastic.value, 1, 4 * plastic.error + 1e-5) << eta << " " << degrees;
      const Mean lacquer =
          white(compiled(LayeredDescription{{0}, eta, 1.0, RgbD(0.0), 1, one}, DiffuseDescription{one}), degrees);
      EXPECT_NEAR(lacquer.value, 1, 4 * lacquer.error + 1e-5) << eta << " " << degrees;
      const Mean mirror =
          white(compiled(LayeredDescription{{0}, eta, 1.0, RgbD(0.0), 1, one}, ConductorDescription{{}, one}), degrees);
      EXPECT_NEAR(mirror.value, 1, 1e-5) << eta << " " << degrees;
    }
  }
}

TEST(bsdf_laws, rough_ones_become_smooth) {
  const RgbD one(1.0);
  for (const MicrofacetDistribution d : {MicrofacetDistribution::beckmann, MicrofacetDistribution::ggx})
    for (const double degrees : {0.0, 50.0, 80.0}) {
      const Vec3f wo = test::slanted(degrees);
      const float smooth = fresnel_dielectric(wo.z, 1.5f).reflectance;
      const Bsdf glass = compiled(RoughDielectricDescription{d, 1e-4, 1e-4, true, 1.5, 1.0, one, one});
      const Bsdf clear = compiled(DielectricDescription{1.5, 1.0, one, one});
      int reflected = 0;
      constexpr int samples = 20'000;
      for (std::uint64_t i = 0; i < samples; ++i) {
        test::Random random(34, i);
        const float u_lobe = random.next();
        const auto rough = test::sample(glass, wo, u_lobe, random.next2(), TransportMode::radiance);
        if (!rough) continue;
        const bool up = rough->wi_local.z > 0;
        reflected += up ? 1 : 0;
        const auto sharp = test::sample(clear, wo, up ? 0.0f : 0.9999f, {}, TransportMode::radiance);
        // Facets beyond 100 times their roughness are one in 10,000 of GGX.
        if (i < 100) {
          EXPECT_LT(length(rough->wi_local - sharp->wi_local), 0.02f) << degrees;
        }
      }
      EXPECT_NEAR(reflected / static_cast<double>(samples), static_cast<double>(smooth), 4 * std::sqrt(0.25 / samples))
          << degrees;
    }
}

/// Share of light lost to second facets by models that follow only one, measured with 10^6 samples a number. The
/// surfaces are white conductors, glass of 1.5 and plastic of 1.5 with a white base, seen from 0, 50 and 88 degrees.
/// One number has a closed form: GGX of roughness 1 from straight above keeps 1 - ln 2 and loses 0.6931. The kept part
/// is the integral of c / (1 + c) over cosines c.
struct Loss {
  const char* model;
  MicrofacetDistribution distribution;
  double alpha;
  std::array<double, 3> loss;
};
const std::vector<Loss> losses = {
    {"conductor", MicrofacetDistribution::beckmann, 0.1, {0.0000, 0.0000, 0.0655}},
    {"conductor", MicrofacetDistribution::beckmann, 0.3, {0.0003, 0.0459, 0.0439}},
    {"conductor", MicrofacetDistribution::beckmann, 0.6, {0.1438, 0.1608, 0.0493}},
    {"conductor", MicrofacetDistribution::beckmann, 1.0, {0.5384, 0.3153, 0.0802}},
    {"conductor", MicrofacetDistribution::ggx, 0.1, {0.0119, 0.0213, 0.1034}},
    {"conductor", MicrofacetDistribution::ggx, 0.3, {0.1225, 0.1638, 0.1315}},
    {"conductor", MicrofacetDistribution::ggx, 0.6, {0.4081, 0.3923, 0.2415}},
    {"conductor", MicrofacetDistribution::ggx, 1.0, {0.6931, 0.6261, 0.4068}},
    {"dielectric", MicrofacetDistribution::beckmann, 0.1, {0.0000, 0.0000, 0.0558}},
    {"dielectric", MicrofacetDistribution::beckmann, 0.3, {0.0000, 0.0083, 0.0290}},
    {"dielectric", MicrofacetDistribution::beckmann, 0.6, {0.0072, 0.0289, 0.0769}},
    {"dielectric", MicrofacetDistribution::beckmann, 1.0, {0.0332, 0.0665, 0.2868}},
    {"dielectric", MicrofacetDistribution::ggx, 0.1, {0.0012, 0.0042, 0.0834}},
    {"dielectric", MicrofacetDistribution::ggx, 0.3, {0.0116, 0.0347, 0.1813}},
    {"dielectric", MicrofacetDistribution::ggx, 0.6, {0.0446, 0.1128, 0.4283}},
    {"dielectric", MicrofacetDistribution::ggx, 1.0, {0.1065, 0.2517, 0.6546}},
    {"plastic", MicrofacetDistribution::beckmann, 0.1, {0.0325, 0.0319, 0.0697}},
    {"plastic", MicrofacetDistribution::beckmann, 0.3, {0.1263, 0.1311, 0.1230}},
    {"plastic", MicrofacetDistribution::beckmann, 0.6, {0.3185, 0.3320, 0.3314}},
    {"plastic", MicrofacetDistribution::beckmann, 1.0, {0.4925, 0.5029, 0.5902}},
    {"plastic", MicrofacetDistribution::ggx, 0.1, {0.0913, 0.0922, 0.1370}},
    {"plastic", MicrofacetDistribution::ggx, 0.3, {0.3087, 0.3209, 0.3899}},
    {"plastic", MicrofacetDistribution::ggx, 0.6, {0.5148, 0.5453, 0.6780}},
    {"plastic", MicrofacetDistribution::ggx, 1.0, {0.6642, 0.7145, 0.8450}},
};

TEST(bsdf_laws, rough_ones_lose_what_the_table_says) {
  const RgbD one(1.0);
  for (const Loss& row : losses) {
    const std::string model = row.model;
    const double a = row.alpha;
    const Bsdf bsdf = model == "conductor" ? compiled(RoughConductorDescription{row.distribution, a, a, true, {}, one})
                      : model == "dielectric"
                          ? compiled(RoughDielectricDescription{row.distribution, a, a, true, 1.5, 1.0, one, one})
                          : compiled(RoughPlasticDescription{row.distribution, a, true, one, one, 1.5, 1.0, false});
    const std::array<double, 3> degrees{0, 50, 88};
    for (std::size_t k = 0; k < 3; ++k) {
      const Mean measured = albedo(bsdf, test::slanted(degrees[k]), 100'000);
      EXPECT_NEAR(1 - measured.value, row.loss[k], 4 * measured.error + 1e-3) << model << " " << a << " " << degrees[k];
    }
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
