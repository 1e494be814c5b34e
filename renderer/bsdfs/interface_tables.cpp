#include "renderer/bsdfs/interface_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>
#include <vector>

namespace photonproof::inline renderer_bsdfs {
namespace {

double fresnel(double cos_incident, double eta) {
  return static_cast<double>(
      fresnel_dielectric(static_cast<float>(std::min(1.0, cos_incident)), static_cast<float>(eta)).reflectance);
}

Vec3f at_cosine(double cos_theta) {
  return {static_cast<float>(std::sqrt(1 - cos_theta * cos_theta)), 0, static_cast<float>(cos_theta)};
}

/// A Fibonacci lattice in two numbers. A regular grid would lie along the circles where facets begin to reflect
/// totally.
constexpr std::uint64_t lattice_points = 6765, lattice_step = 4181;
double lattice_fraction(std::uint64_t k) { return (static_cast<double>(k) + 0.5) / lattice_points; }

/// Slopes of facets of a Beckmann surface of roughness 1, by area. Lattices suit periodic numbers, such as the angle.
/// The other number is therefore folded: it goes up to 1 and back ("baker's transformation", Hickernell 2002).
const std::vector<Vec2<float>>& beckmann_slopes() {
  static const std::vector<Vec2<float>> slopes = [] {
    std::vector<Vec2<float>> made;
    for (std::uint64_t i = 0; i < lattice_points; ++i) {
      const double radius = std::sqrt(-std::log1p(-std::abs(2 * lattice_fraction(i) - 1)));
      const double angle = 2 * std::numbers::pi * lattice_fraction(i * lattice_step % lattice_points);
      made.push_back({static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))});
    }
    return made;
  }();
  return slopes;
}

/// Mean over facets by area, each weighted by its area visible from wo. The same slopes serve every wo; sampling
/// visible normals would need Newton's method for each.
template <class Value>
double mean_over_beckmann_facets(const Microfacets<float>& facets, const Vec3f& wo, const Value& value) {
  double sum = 0, seen = 0;
  for (const Vec2<float>& slope : beckmann_slopes()) {
    const Vec3f up(facets.alpha_u() * slope.x, facets.alpha_v() * slope.y, 1.0f);
    const double area = std::max(0.0, static_cast<double>(dot(wo, up)));
    seen += area;
    if (area > 0) sum += area * value(normalize(up));
  }
  return sum / seen;
}

/// Mean over visible facets: GGX has facets so steep that weights by area would vary without bound.
template <class Value>
double mean_over_ggx_facets(Microfacets<float> facets, const Vec3f& wo, const Value& value) {
  facets.sample_visible = 1;
  double sum = 0;
  for (std::uint64_t i = 0; i < lattice_points; ++i) {
    const Vec3f m = facets.sample(wo, {static_cast<float>(lattice_fraction(i)),
                                       static_cast<float>(lattice_fraction(i * lattice_step % lattice_points))});
    if (dot(wo, m) > 0) sum += value(m);
  }
  return sum / lattice_points;
}

/// Mean over the facets that wo sees.
template <class Value>
double mean_over_facets(const Microfacets<float>& facets, const Vec3f& wo, const Value& value) {
  return facets.is_ggx > 0 ? mean_over_ggx_facets(facets, wo, value) : mean_over_beckmann_facets(facets, wo, value);
}

}  // namespace

double diffuse_fresnel_loss(double eta, double depth) {
  // The loss, by the midpoint rule in the cosine on the side of the smaller index: all light that crosses comes from
  // there. On the other side it lies in a cone, at eta = 0.01 in 1/20000 of the cosines.
  constexpr int cells = 20'000;
  const double n = std::max(eta, 1 / eta), shrink = eta < 1 ? 1 / (n * n) : 1;  // factor of d(cos^2) into the cone
  double absorbed = 0, through = 0;
  for (int i = 0; i < cells; ++i) {
    const double cos_theta = (i + 0.5) / cells;
    const double cos_light = std::sqrt(1 - shrink * (1 - cos_theta * cos_theta));
    absorbed -= 2 * cos_theta * std::expm1(-2 * depth / cos_theta);
    through += 2 * cos_theta * shrink * (1 - fresnel(cos_theta, n)) * std::exp(-2 * depth / cos_light);
  }
  return (absorbed + through) / cells;
}

double fitted_diffuse_reflectance(double eta) {
  if (eta < 1) return -1.4399 * eta * eta + 0.7099 * eta + 0.6681 + 0.0636 / eta;
  const double x = 1 / eta;
  return 0.919317 + x * (-3.4793 + x * (6.75335 + x * (-7.80989 + x * (4.98554 - x * 1.36881))));
}

double rough_reflectance(const Microfacets<float>& facets, double cos_wo, double eta) {
  const Vec3f wo = at_cosine(cos_wo);
  return mean_over_facets(facets, wo, [&](const Vec3f& m) -> double {
    const Vec3f wi = mirrored(wo, m);
    const DielectricFresnel<float> facet = fresnel_dielectric(clamp_to_unit(dot(wo, m)), static_cast<float>(eta));
    return wi.z > 0 ? static_cast<double>(facet.reflectance * facets.shadowing(wi)) : 0;
  });
}

double rough_transmittance(const Microfacets<float>& facets, double cos_wo, double eta) {
  const Vec3f wo = at_cosine(cos_wo);
  const auto to_path = static_cast<float>(1 / eta);
  return mean_over_facets(facets, wo, [&](const Vec3f& m) -> double {
    const float cos_facet = dot(wo, m);
    const DielectricFresnel<float> facet = fresnel_dielectric(clamp_to_unit(cos_facet), static_cast<float>(eta));
    const Vec3f wi = advance(Vec3f(-wo * to_path), cos_facet * to_path - facet.cos_transmit, m);
    return wi.z < 0 ? static_cast<double>((1 - facet.reflectance) * facets.shadowing(wi)) : 0;
  });
}

namespace {

RoughInterface integrated_interface(const Microfacets<float>& facets, double eta) {
  RoughInterface result;
  constexpr int nodes = 32;
  std::array<double, nodes> angle, through;
  for (std::size_t j = 0; j < nodes; ++j) {
    angle[j] = std::numbers::pi * (static_cast<double>(j) + 0.5) / nodes;
    const double root = 0.5 * (std::cos(angle[j]) + 1);
    through[j] = rough_transmittance(facets, root * root, eta);
  }
  for (std::size_t k = 0; k < result.through.size(); ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) sum += through[j] * std::cos(static_cast<double>(k) * angle[j]);
    result.through[k] = static_cast<float>(sum * (k == 0 ? 1.0 : 2.0) / nodes);
  }
  constexpr int cosines = 64;
  double inside = 0;
  for (int i = 0; i < cosines; ++i) {
    const double cos_theta = std::max(1e-6, i / (cosines - 1.0));
    inside += 2 * cos_theta * rough_reflectance(facets, cos_theta, 1 / eta);
  }
  result.lost_inside = static_cast<float>(1 - inside / cosines);
  return result;
}

/// Cache of recent integrals, shared by any number of threads. Materials of a scene, and scenes of a run, are often
/// alike. A table takes 0.02 s, for GGX 0.06 s.
class KnownInterfaces {
 public:
  RoughInterface of(const Microfacets<float>& facets, double eta) {
    const Key key{facets.raw_alpha_u, facets.raw_alpha_v, facets.is_ggx, eta};
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = known_.find(key); found != known_.end()) return found->second;
    }
    const RoughInterface made = integrated_interface(facets, eta);
    const std::scoped_lock lock(mutex_);
    if (known_.size() >= most) known_.clear();
    return known_.emplace(key, made).first->second;
  }

 private:
  static constexpr std::size_t most = 256;
  using Key = std::tuple<float, float, float, double>;
  std::mutex mutex_;
  std::map<Key, RoughInterface> known_;
};

}  // namespace

RoughInterface rough_interface(const Microfacets<float>& facets, double eta) {
  static KnownInterfaces known;
  return known.of(facets, eta);
}

}  // namespace photonproof::inline renderer_bsdfs
