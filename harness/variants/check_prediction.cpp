#include <algorithm>
#include <cstdint>
#include <string>

#include "harness/statistics/agreement.h"
#include "harness/variants/variant.h"

namespace photonproof::inline harness_variants {
namespace {

/// A multiple of 12, which every kind can divide.
int small_side(int side, int longer, int longer_side) {
  const double exact = static_cast<double>(side) * longer_side / longer;
  return std::max(24, static_cast<int>(exact / 12 + 0.5) * 12);
}

std::string worst_of(const Agreement& agreement) {
  if (!agreement.whole.pass) return agreement.whole.sentence;
  return agreement.blocks.pass ? agreement.pixels.sentence : agreement.blocks.sentence;
}

}  // namespace

std::string check_prediction(const Variant& asked, const SceneDescription& base, const OwnEngine& engine,
                             const VariantOptions& options, const PredictionCheck& check) {
  if (asked.needs_reference()) return "";
  const int width = base.sensor.film.width, height = base.sensor.film.height, longer = std::max(width, height);
  // A large variant is checked by a small copy of it.
  const bool is_small = std::max(asked.width, asked.height) <= check.longer_side;
  const Variant variant = is_small
                              ? asked
                              : make_variant(asked.kind, asked.seed, base, small_side(width, longer, check.longer_side),
                                             small_side(height, longer, check.longer_side), options);
  SceneDescription whole = base;
  whole.sensor.film.crop.reset();
  const auto render = [&](const SceneDescription& scene, int w, int h, std::uint64_t seed) {
    OwnRender how{.width = w, .height = h, .spp = check.spp, .seed = seed, .integrator = check.integrator};
    how.more = {"--sampler", "independent"};
    return render_with(engine, scene, how);
  };
  std::string why;
  // Two seeds: a wrong prediction fails with both. Chance, and samples too rare to know their variance, hardly ever do.
  for (const std::uint64_t seed : {1, 2}) {
    const Rendering from = render(whole, variant.base_width, variant.base_height, 2 * seed);
    const Rendering got = render(variant.scene, variant.width, variant.height, 2 * seed + 1);
    Rendering expected;
    expected.mean = variant.predicted(from.mean);
    if (from.variance) expected.variance = variant.predicted_variance(*from.variance);
    const Agreement agreement = test_agreement(expected, got, check.alpha);
    if (agreement.pass()) return "";
    why = "our own engine does not show what is predicted of " + asked.kind + " (" + asked.says +
          "): " + worst_of(agreement);
  }
  return why;
}

}  // namespace photonproof::inline harness_variants
