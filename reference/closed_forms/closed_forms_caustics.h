// Caustics of a collimated beam: through a ball of glass, and through water with a sinusoidal surface. Each is a map
// from where a ray enters to where it lands; flux is carried along, so E = sum over the rays that land there of
// E_0 T |d(area at entry) / d(area at landing)|, infinite at a fold. Lengths in scene units, E in W m^-2 per unit of
// the beam's E_0; reflectances without polarisation, the mean of s and p at every interface.
#pragma once

namespace photonproof::inline reference_closed_forms {

/// A ball around the origin in a beam along +x, and a screen x = screen, beyond it.
struct BallLens {
  double radius, ior, screen;
};

/// One way through the ball: 0 is reflection off its outside, 1 straight through, p >= 2 with p - 1 reflections inside.
struct BallRay {
  bool lands;      ///< false where it never gets to the screen
  double landing;  ///< signed distance from the axis, negative across it
  double part;     ///< of the ray's flux that goes this way: F, (1-F)^2 F^(p-1)
};
/// Of the ray that enters at the distance 0 <= h < radius from the axis. Deviations as van de Hulst (1957, section
/// 12.2): 2 (i - t) + (p - 1)(pi - 2 t); by symmetry the ray leaves at the distance h from the centre, too, so it lands
/// at (h - screen sin D) / cos D.
BallRay trace_ball(const BallLens& lens, double h, int order);

/// E(r)/E_0 at the distance r > 0 from the axis: the sum over orders up to `orders` of part h |dh/dr| / r; and the
/// beam itself beyond the ball's shadow, 1 where r > radius.
double ball_lens_irradiance(const BallLens& lens, double r, int orders);

/// Water over a floor, its surface at depth + amplitude cos(2 pi x / wavelength), in a beam straight down.
struct SinusoidalWater {
  double amplitude, wavelength, depth, ior;
};

struct WaterRay {
  double landing;        ///< x on the floor
  double transmittance;  ///< 1 - F at the surface
};
/// Of the ray that meets the surface at x; x is measured across the beam, so that E_0 dx is its flux.
WaterRay trace_water(const SinusoidalWater& water, double x);

/// E(x)/E_0 on the floor: the sum over rays that land at `x` of T / |dx'/dx|. (With the arc length s of the surface in
/// place of x it is T cos(angle) / |dx'/ds|.)
double water_irradiance(const SinusoidalWater& water, double x);

}  // namespace photonproof::inline reference_closed_forms
