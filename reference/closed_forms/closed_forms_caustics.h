// Caustics of a collimated beam: through a ball of glass, and through water with a sinusoidal surface. Each is a map
// from where a ray enters to where it lands, which preserves flux. So E is the sum over the rays that land at a point
// of E_0 T |d(area at entry) / d(area at landing)|, infinite at a fold. Lengths are in scene units, E in W m^-2 per
// unit of the beam's E_0. Reflectances are unpolarised: the mean of s and p at every interface.
#pragma once

namespace photonproof::inline reference_closed_forms {

/// A ball around the origin in a beam along +x, and a screen x = screen, beyond it.
struct BallLens {
  double radius, ior, screen;
};

/// One path through the ball: 0 is reflection off its outside, 1 straight through, p >= 2 has p - 1 inner reflections.
struct BallRay {
  bool lands;      ///< False where the ray never reaches the screen.
  double landing;  ///< Signed distance from the axis, negative across it.
  double part;     ///< Share of the ray's flux that takes this path: F, (1-F)^2 F^(p-1).
};
/// Traces the ray that enters at the distance 0 <= h < radius from the axis. Its deviation D is van de Hulst's (1957,
/// section 12.2): 2 (i - t) + (p - 1)(pi - 2 t). By symmetry the ray also leaves at the distance h from the centre, so
/// it lands at (h - screen sin D) / cos D.
BallRay trace_ball(const BallLens& lens, double h, int order);

/// E(r)/E_0 at the distance r > 0 from the axis: the sum over orders up to `orders` of part h |dh/dr| / r. Beyond the
/// ball's shadow, where r > radius, the beam itself adds 1.
double ball_lens_irradiance(const BallLens& lens, double r, int orders);

/// Water over a floor, its surface at depth + amplitude cos(2 pi x / wavelength), in a beam straight down.
struct SinusoidalWater {
  double amplitude, wavelength, depth, ior;
};

struct WaterRay {
  double landing;        ///< x on the floor
  double transmittance;  ///< 1 - F at the surface
};
/// The ray that meets the surface at x. The coordinate x is measured across the beam, so E_0 dx is the ray's flux.
WaterRay trace_water(const SinusoidalWater& water, double x);

/// E(x)/E_0 on the floor: the sum over rays that land at `x` of T / |dx'/dx|. (With the arc length s of the surface in
/// place of x it is T cos(angle) / |dx'/ds|.)
double water_irradiance(const SinusoidalWater& water, double x);

}  // namespace photonproof::inline reference_closed_forms
