// Weights of bidirectional path tracing (Veach 1997, chapters 9 and 10). Both subpaths carry partial sums, so the cost
// of a weight does not depend on the path's length. The idea is from Georgiev 2012, "Implementing Vertex Connection and
// Merging".
//
// A path x_0 ... x_k leads from a light to the camera. In strategy s a light path makes x_0 ... x_(s-1) and a camera
// path the rest. The density per area of x_i is f_i if made from the light's side, and b_i if made from the camera's
// side. The density of strategy s is p_s = f_0 ... f_(s-1) b_s ... b_k. Neighbours differ by one vertex:
// p_(i)/p_(i+1) = b_i/f_i. The weight of s among all strategies follows the power heuristic with exponent 2.
//   `w_s = 1 / (1 + D_s + U_s),   D_s = sum over j < s of (p_j/p_s)^2,   U_s = sum over j > s of (p_j/p_s)^2`.
// Peeling off one vertex gives D_s = (b_(s-1)/f_(s-1))^2 (1 + D_(s-1)). A light path that has come to x_(s-1) knows all
// of D_s except two numbers, which depend on x_s. One is b_(s-1). The other is the density t with which scattering at
// x_(s-1) would have gone on to x_(s-2). It gives b_(s-2) = t g_(s-2), with g the cosine at the vertex over the squared
// distance. So
//   `D_s = b_(s-1)^2 (A_(s-1) + t^2 B_(s-1))`,
//   `A_i = 1 / f_i^2,   B_i = (g_(i-1) / f_i)^2 (A_(i-1) + t_(i-1)^2 B_(i-1))`
// and a subpath carries A and B. U_s is the same seen from the camera. No strategy can join two vertices where one of
// them scatters into a single direction. At such an x_(i-1) B_i omits A_(i-1), and A_i is 0. The probabilities of its
// lobe are the same both ways and cancel.
//
// The ends differ. Next-event estimation (s = 1) draws x_0 anew with a density d_0 of its own, so the last factor
// becomes (d_0/f_0)^2. Camera paths do not meet the lens, so every strategy has a camera vertex. Only camera paths show
// directly visible light, so s = 1 does not join the lens. Light at infinity has directions in place of points: see
// EmissionPdfs.
//
// No density contains roulette by throughput. Weights need only be the same function of the path in every strategy,
// which they are. But half of the long paths would join a long light path with a long camera path. All their pairs take
// time to join, with the product of two rare survivors' weights. So constant roulette also cuts light paths: they
// continue with the probability `light_goes_on`. That factor is in f_i and in the density of going on from the light's
// side. Where light bounces for long, camera paths then do most of it, as in path tracing.
#pragma once

namespace photonproof::inline renderer_integrators {

/// Probability that a light path continues where nothing is absorbed.
inline constexpr float light_goes_on = 0.95f;

/// The sums A and B at a subpath's last vertex. Squares of densities exceed the range of floats.
class SubpathWeights {
 public:
  SubpathWeights() = default;
  SubpathWeights(double a, double b) : a_(a), b_(b) {}

  /// Ratio D_s or U_s when the subpath's end is joined or met. `made` is the density per area with which the other side
  /// makes the last vertex. `back` is that side's density per solid angle of continuing to the vertex before.
  double ratio(double made, double back) const { return made * made * (a_ + back * back * b_); }

  /// The same where the last vertex is on a light that was met. `anew` is the density per area of next-event estimation
  /// for it. `emitted` is the density of a light path's start there times that of its direction, per solid angle.
  double ratio_of_light(double anew, double emitted) const { return anew * anew * a_ + emitted * emitted * b_; }

  /// Updates the sums when the last vertex scatters. Arguments: densities of the new direction and of the way back, per
  /// solid angle, and the cosine of the new direction.
  void scatter(double pdf, double back, double cos_out) {
    const double stretch = cos_out / pdf;
    b_ = stretch * stretch * (a_ + back * back * b_);
    a_ = 1 / (pdf * pdf);
  }
  /// The same for a delta lobe. `back_over_forth` is the ratio of the two ways' probabilities.
  void scatter_delta(double back_over_forth, double cos_out) {
    const double stretch = cos_out * back_over_forth;
    b_ *= stretch * stretch;
    a_ = 0;
  }
  /// Converts densities per solid angle to densities per area when the ray arrives at a surface.
  void arrive(double distance2, double cos_in) {
    const double cos2 = cos_in * cos_in;
    a_ *= distance2 * distance2 / cos2;
    b_ /= cos2;
  }

 private:
  double a_ = 0, b_ = 0;
};

}  // namespace photonproof::inline renderer_integrators
