// Weights of bidirectional path tracing (Veach 1997, chapters 9 and 10), carried along both subpaths so that each costs
// the same however long the path is (the idea of Georgiev 2012, "Implementing Vertex Connection and Merging").
//
// A path x_0 ... x_k leads from a light to the camera. Strategy s lets a light path make x_0 ... x_(s-1) and a camera
// path the rest. With f_i the density per area of x_i made from the light's side and b_i that of x_i made from the
// camera's side, p_s = f_0 ... f_(s-1) b_s ... b_k, and neighbours differ by one vertex: p_(i)/p_(i+1) = b_i/f_i. The
// weight of s among all strategies, by the power heuristic with exponent 2, is
//   w_s = 1 / (1 + D_s + U_s),   D_s = sum over j < s of (p_j/p_s)^2,   U_s = sum over j > s of (p_j/p_s)^2.
// Peeling off one vertex, D_s = (b_(s-1)/f_(s-1))^2 (1 + D_(s-1)). Of what D_s needs, a light path that has come to
// x_(s-1) lacks two numbers, which depend on x_s: b_(s-1), and the density t with which scattering at x_(s-1) would
// have gone on to x_(s-2), as b_(s-2) = t g_(s-2) with g the cosine at the vertex over the squared distance. So
//   D_s = b_(s-1)^2 (A_(s-1) + t^2 B_(s-1)),
//   A_i = 1 / f_i^2,   B_i = (g_(i-1) / f_i)^2 (A_(i-1) + t_(i-1)^2 B_(i-1))
// and A, B are what a subpath carries. U_s is the same seen from the camera. No strategy can join two vertices where
// one of them scatters into a single direction: at such an x_(i-1) A_(i-1) is left out of B_i, and A_i is 0; the
// probabilities of its lobe are the same both ways and cancel.
//
// Where the ends differ: next-event estimation (s = 1) draws x_0 anew with a density d_0 of its own, so that the last
// step is to (d_0/f_0)^2. Camera paths do not meet the lens (no strategy without a camera vertex), and the light seen
// directly is left to camera paths, so s = 1 does not join the lens. Light at infinity has directions in place of
// points: see EmissionPdfs.
//
// Roulette by throughput is in no density: weights need only be the same function of the path in every strategy, which
// they are. But of long paths, half are made by a long light path and a long camera path, all pairs of which it takes
// time to join, with the product of two rare survivors' weights. So light paths are also cut by constant roulette: an
// edge more has probability `light_goes_on`, and that is in f_i and in the density of going on from the light's side.
// Where light goes round for long, camera paths then do most of it, in the way of path tracing.
#pragma once

namespace photonproof::inline renderer_integrators {

/// Probability that a light path goes on where nothing is absorbed.
inline constexpr float light_goes_on = 0.95f;

/// A and B of a subpath's last vertex. Squares of densities span more than floats do.
class SubpathWeights {
 public:
  SubpathWeights() = default;
  SubpathWeights(double a, double b) : a_(a), b_(b) {}

  /// Of the path so far as its end is joined or met: `made` is the density per area with which the other side makes its
  /// last vertex, `back` per solid angle that with which it goes on to the one before.
  double ratio(double made, double back) const { return made * made * (a_ + back * back * b_); }

  /// The same where the last vertex is on a light that was met: `anew` is the density per area of next-event estimation
  /// for it, `emitted` that of a light path's start there times that of its direction, per solid angle.
  double ratio_of_light(double anew, double emitted) const { return anew * anew * a_ + emitted * emitted * b_; }

  /// The last vertex scatters: densities of the new direction and of the way back, per solid angle, and the cosine of
  /// the new direction.
  void scatter(double pdf, double back, double cos_out) {
    const double stretch = cos_out / pdf;
    b_ = stretch * stretch * (a_ + back * back * b_);
    a_ = 1 / (pdf * pdf);
  }
  /// The same where it goes on in its one direction. `back_over_forth` is the ratio of the two ways' probabilities.
  void scatter_delta(double back_over_forth, double cos_out) {
    const double stretch = cos_out * back_over_forth;
    b_ *= stretch * stretch;
    a_ = 0;
  }
  /// The ray arrives at a surface: from densities per solid angle to those per area.
  void arrive(double distance2, double cos_in) {
    const double cos2 = cos_in * cos_in;
    a_ *= distance2 * distance2 / cos2;
    b_ /= cos2;
  }

 private:
  double a_ = 0, b_ = 0;
};

}  // namespace photonproof::inline renderer_integrators
