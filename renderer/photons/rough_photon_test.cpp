// Photons with directions keep them, and their colour, in the words of three columns.

#include "renderer/photons/rough_photon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/lanes/test_random.h"
#include "renderer/photons/photon_columns.h"

namespace photonproof::inline renderer_photons {
namespace {

TEST(rough_photon, keeps_its_direction_to_a_few_thousandths_of_a_degree_and_its_flux_to_half_a_thousandth) {
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    test::Random random(51, i);
    Vec3f to_light = normalize(Vec3f{random.next() - 0.5f, random.next() - 0.5f, random.next() - 0.5f});
    if (i < 6)
      to_light = {i == 0   ? 1.0f
                  : i == 1 ? -1.0f
                           : 0,
                  i == 2   ? 1.0f
                  : i == 3 ? -1.0f
                           : 0,
                  i == 4   ? 1.0f
                  : i == 5 ? -1.0f
                           : 0};
    const float brightness = std::exp2(80 * (random.next() - 0.5f));
    const Rgb flux = Rgb{random.next(), random.next(), i % 3 == 0 ? 0.0f : random.next()} * brightness;
    const RoughPhotonWords<float> words = rough_photon_words<float>(flux, to_light);
    const Vec3f back = direction_of_rough_photon<float>(words);
    EXPECT_NEAR(length(back), 1, 1e-6);
    ASSERT_LT(length(back - to_light), 1e-4) << i;  // 0.006 degrees
    const Rgb colour = flux_of_rough_photon<float>(words);
    for (const auto channel : {&Rgb::x, &Rgb::y, &Rgb::z})
      ASSERT_NEAR(colour.*channel, flux.*channel, 0.00051 * double{words.largest}) << i;
  }
}

TEST(rough_photon, has_its_flux_as_any_other_photon) {
  const RoughPhotonWords<float> words = rough_photon_words<float>(Rgb{1, 2, 4}, Vec3f{0, 0, 1});
  PhotonColumns<OneValue> row{};
  row.red = words.largest, row.green = from_word<float>(words.shares), row.blue = from_word<float>(words.direction);
  row.surface = 5 | PhotonSurface::rough;
  const Photon photon = photon_of(row);
  EXPECT_NEAR(photon.flux.x, 1, 0.002);
  EXPECT_NEAR(photon.flux.y, 2, 0.002);
  EXPECT_NEAR(photon.flux.z, 4, 0.002);
}

}  // namespace
}  // namespace photonproof::inline renderer_photons
