#include "reference/closed_forms/closed_forms_caustics.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "reference/closed_forms/closed_forms_glass.h"

namespace photonproof::inline reference_closed_forms {
namespace {

using std::numbers::pi;

/// Sum of weight(x) / |f'(x)| over the solutions of f(x) = target in (from, to), searched in `steps` equal intervals.
template <class F, class Weight>
double sum_over_solutions(const F& f, const Weight& weight, double target, double from, double to, int steps) {
  const double step = (to - from) / steps;
  double sum = 0;
  double left = from, f_left = f(from) - target;
  for (int i = 1; i <= steps; ++i) {
    const double right = from + i * step, f_right = f(right) - target;
    if ((f_left < 0) != (f_right < 0)) {  // false with a NaN only where the other is not negative either
      double a = left, b = right;
      for (int bisection = 0; bisection < 60; ++bisection) {
        const double middle = (a + b) / 2;
        ((f(middle) - target < 0) == (f_left < 0) ? a : b) = middle;
      }
      const double x = (a + b) / 2, h = 1e-3 * step;
      const double slope = (f(x + h) - f(x - h)) / (2 * h);
      if (std::isfinite(slope) && slope != 0) sum += weight(x) / std::abs(slope);
    }
    left = right;
    f_left = f_right;
  }
  return sum;
}

}  // namespace

BallRay trace_ball(const BallLens& lens, double h, int order) {
  const double i = std::asin(h / lens.radius), t = refraction_angle(i, lens.ior);
  const double F = fresnel_reflectance(i, lens.ior).unpolarised();
  const double part = order == 0 ? F : (1 - F) * (1 - F) * std::pow(F, order - 1);
  // Towards the axis positive; reflection off the outside turns away from it.
  const double deviation = order == 0 ? 2 * i - pi : 2 * (i - t) + (order - 1) * (pi - 2 * t);
  const double forward = std::cos(deviation);
  return {forward > 0, (h - lens.screen * std::sin(deviation)) / forward, part};
}

double ball_lens_irradiance(const BallLens& lens, double r, int orders) {
  constexpr int steps = 1000;
  double sum = r > lens.radius ? 1 : 0;
  for (int order = 0; order <= orders; ++order)
    for (const double side : {r, -r}) {
      const auto landing = [&](double h) {
        const BallRay ray = trace_ball(lens, h, order);
        return ray.lands ? ray.landing : std::nan("");
      };
      const auto weight = [&](double h) { return trace_ball(lens, h, order).part * h / r; };
      sum += sum_over_solutions(landing, weight, side, 0, lens.radius, steps);
    }
  return sum;
}

WaterRay trace_water(const SinusoidalWater& water, double x) {
  const double k = 2 * pi / water.wavelength;
  const double slope = -water.amplitude * k * std::sin(k * x);
  const double angle = std::atan(std::abs(slope));
  const double turned = std::copysign(angle - refraction_angle(angle, water.ior), slope);  // towards the crest
  const double height = water.depth + water.amplitude * std::cos(k * x);
  return {x + height * std::tan(turned), 1 - fresnel_reflectance(angle, water.ior).unpolarised()};
}

double water_irradiance(const SinusoidalWater& water, double x) {
  // No ray is turned by more than the largest slope's angle.
  const double slope = 2 * pi * water.amplitude / water.wavelength;
  const double reach = (water.depth + water.amplitude) * slope;
  const int steps = 500 * (1 + static_cast<int>(std::ceil(2 * reach / water.wavelength)));
  const auto landing = [&](double from) { return trace_water(water, from).landing; };
  const auto weight = [&](double from) { return trace_water(water, from).transmittance; };
  return sum_over_solutions(landing, weight, x, x - reach, x + reach, steps);
}

}  // namespace photonproof::inline reference_closed_forms
