// A record of every kind of BSDF with random parameters over all values that scenes can give. Test code only.
#pragma once

#include <cmath>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/lanes/test_random.h"

namespace photonproof::test {

inline Rgb some_colour(Random& random) { return {random.next(), random.next(), random.next()}; }
inline float some_switch(Random& random) { return random.next() < 0.5f ? 0.0f : 1.0f; }
inline float some_eta(Random& random) { return 0.3f + 3.2f * random.next(); }
inline float some_alpha(Random& random) { return std::pow(10.0f, -4 * random.next()); }
inline Microfacets<float> some_facets(Random& random) {
  return {some_alpha(random), some_alpha(random), some_switch(random), some_switch(random)};
}

inline void randomise(DiffuseBsdf<float>& b, Random& random) { b = {some_colour(random)}; }
inline void randomise(ConductorBsdf<float>& b, Random& random) {
  b = {some_colour(random), some_switch(random), some_colour(random) * 3.0f, some_colour(random) * 8.0f};
}
inline void randomise(DielectricBsdf<float>& b, Random& random) {
  b = {some_eta(random), some_colour(random), some_colour(random)};
}
inline void randomise(NullBsdf<float>& b, Random& random) { b = {some_colour(random)}; }
inline void randomise(DiffuseTransmitterBsdf<float>& b, Random& random) { b = {some_colour(random)}; }
inline void randomise(RoughConductorBsdf<float>& b, Random& random) {
  b = {some_facets(random), some_colour(random), some_switch(random), some_colour(random) * 3.0f,
       some_colour(random) * 8.0f};
}
inline void randomise(ThinDielectricBsdf<float>& b, Random& random) {
  b = {some_eta(random), some_colour(random), some_colour(random)};
}
inline void randomise(RoughDielectricBsdf<float>& b, Random& random) {
  b = {some_facets(random), some_eta(random), some_colour(random), some_colour(random)};
}
inline void randomise(PlasticBsdf<float>& b, Random& random) {
  b = {some_eta(random), 0.9f * random.next(), some_switch(random), some_colour(random), some_colour(random)};
}
inline void randomise(RoughPlasticBsdf<float>& b, Random& random) {
  b = {some_facets(random),
       some_eta(random),
       0.9f * random.next(),
       some_switch(random),
       some_colour(random),
       some_colour(random),
       {}};
  for (float& c : b.through) c = random.next() / RoughPlasticBsdf<float>::coefficients;
}
inline void randomise(PhongBsdf<float>& b, Random& random) {
  b = {std::pow(10.0f, 5 * random.next() - 1), some_colour(random), some_colour(random)};
}
inline PrincipledBase<float> some_base(Random& random) {
  return {some_colour(random), random.next(), random.next(), some_switch(random) * random.next(), random.next()};
}
template <bool has_glass>
void randomise(AnyPrincipledBsdf<float, has_glass>& b, Random& random) {
  b = {some_base(random), random.next(),    random.next(), random.next(), random.next(), random.next(),
       random.next(),     some_eta(random), random.next(), random.next(), random.next()};
}
inline void randomise(PrincipledThinBsdf<float>& b, Random& random) {
  b = {some_base(random),    random.next(), random.next(), random.next(), some_eta(random),
       2.0f * random.next(), random.next(), random.next(), random.next(), random.next()};
}
template <template <class> class Base>
void randomise(LayeredBsdf<float, Base>& b, Random& random) {
  randomise(b.base, random);
  b.eta = some_eta(random);
  b.depth = some_colour(random) * 2.0f;
  b.lost_inside = Rgb(1.0f) - some_colour(random) * 0.9f;
  b.specular = some_colour(random);
}

}  // namespace photonproof::test
