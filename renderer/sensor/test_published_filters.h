// Filters with negative lobes from their published formulas, for tests: no code of the renderer's.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::test {

struct PublishedFilter {
  std::string name, xml;
  ReconstructionFilter filter;
  double radius;
  std::function<double(double)> value;  ///< up to a factor
};

/// Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", equation 8.
inline double mitchell_netravali(double x, double b, double c) {
  const double a = std::abs(x), a2 = a * a, a3 = a2 * a;
  if (a < 1) return ((12 - 9 * b - 6 * c) * a3 + (-18 + 12 * b + 6 * c) * a2 + (6 - 2 * b)) / 6;
  if (a < 2) return ((-b - 6 * c) * a3 + (6 * b + 30 * c) * a2 + (-12 * b - 48 * c) * a + (8 * b + 24 * c)) / 6;
  return 0;
}

/// Catmull and Rom 1974, the interpolating cubic of Keys 1981 with a = -1/2.
inline double keys(double x) {
  const double a = std::abs(x);
  if (a < 1) return 1.5 * a * a * a - 2.5 * a * a + 1;
  return a < 2 ? -0.5 * a * a * a + 2.5 * a * a - 4 * a + 2 : 0;
}

/// Duchon 1979: sin(pi x) sin(pi x / tau) tau / (pi x)^2 up to the radius.
inline double lanczos(double x, double radius, double tau) {
  const double angle = std::numbers::pi * x;
  if (std::abs(x) >= radius) return 0;
  return std::abs(x) < 1e-9 ? 1 : std::sin(angle) * std::sin(angle / tau) * tau / (angle * angle);
}

inline std::vector<PublishedFilter> published_filters() {
  using Kind = ReconstructionFilter::Kind;
  const auto xml = [](const std::string& type, const std::string& parameters = "") {
    return "<rfilter type='" + type + "'>" + parameters + "</rfilter>";
  };
  return {
      {"mitchell",
       xml("mitchell"),
       {.kind = Kind::mitchell},
       2,
       [](double x) { return mitchell_netravali(x, 1.0 / 3, 1.0 / 3); }},
      {"mitchell 0.1, 0.9, radius 3",
       xml("mitchell", "<float name='B' value='0.1'/><float name='C' value='0.9'/><float name='radius' value='3'/>"),
       {.kind = Kind::mitchell, .b = 0.1, .c = 0.9, .mitchell_radius = 3},
       3,
       [](double x) { return mitchell_netravali(x / 1.5, 0.1, 0.9); }},
      {"catmullrom", xml("catmullrom"), {.kind = Kind::catmullrom}, 2, keys},
      {"lanczos", xml("lanczos"), {.kind = Kind::lanczos}, 3, [](double x) { return lanczos(x, 3, 3); }},
      {"lanczos 5",
       xml("lanczos", "<integer name='lobes' value='5'/>"),
       {.kind = Kind::lanczos, .lobes = 5},
       5,
       [](double x) { return lanczos(x, 5, 5); }},
      {"sinc", xml("sinc"), {.kind = Kind::sinc}, 4, [](double x) { return lanczos(x, 4, 3); }},
  };
}

/// The integral by the midpoint rule; f may have kinks at multiples of 1 / 2.
template <class F>
double integral_of(double from, double to, F&& f) {
  if (!(to > from)) return 0;
  constexpr int steps = 20'000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += f(from + (to - from) * (i + 0.5) / steps);
  return sum * (to - from) / steps;
}

}  // namespace photonproof::test
