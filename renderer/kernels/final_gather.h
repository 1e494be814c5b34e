// Final gathering (Jensen 1996; 2001, chapter 8). Photons of the global map are gathered one bounce beyond the first
// Lambertian surface of the camera path. There the error of a gather is averaged over many paths.
//
// Classes of paths, in Heckbert's notation from the light to the eye. S is every surface that is not Lambertian, smooth
// or rough; x is the first Lambertian vertex from the eye and y the next one.
//   L S* E                        Rays that meet lights, and light samples where S is rough.
//   L D(x) S* E                   Light samples at x; with an environment also the ray that leaves x, weighted.
//   L S+ D(x) S* E                The caustic map at x.
//   L D(y) S* D(x) S* E           Light samples at y; with an environment also one more ray, weighted.
//   L S+ D(y) S* D(x) S* E        The caustic map at y.
//   L (S|D)* D S* D(y) S* D(x) S* E   The global map at y.
// These are all paths, each once. So between x and y a light that is met counts only at the end of the ray that leaves
// x. Light samples at S do not count there. Both belong to L S+ D(x) S* E.
// Where y is nearer to x than a gather reaches, in corners, its disc would hold x's own surroundings. There y stands
// between x and a third vertex z. The classes of y are as those of x, those of z as those of y above.
//   L D(z) S* D(y) S* D(x) S* E and so on.
//
// Path tracing beside a caustic map continues from y instead of gathering from the global map. Its classes follow.
//   L S* E, L D(x) S* E           As above.
//   L D(y) S* D(x) S* E           Light samples at y and the rays that leave it, weighted.
//   L S+ D(x) S* E, L S+ D(y) S* D(x) S* E   The caustic map at x and at y.
//   L (S|D)* D(z) S* D(y) S* D(x) S* E       Path tracing from z on, the next Lambertian vertex, by all techniques.
// Light that it finds by rare reflections has gone through two diffuse bounces by then.
#pragma once

#include <cstdint>

#include "renderer/lanes/lane.h"

namespace photonproof::final_gather {

/// Bits of PathState::gathering: which of the Lambertian vertices the path has left, none at first, and whether any
/// other surface has scattered it since.
constexpr std::uint32_t left_first = 1, left_near = 2, not_lambertian_since = 4, path_tracing = 8;
/// Bits until the first of them (rough_gather.h): whether a rough part has scattered the path, and was the last to.
constexpr std::uint32_t any_rough = 16, last_rough = 32;

/// Whether the path has left no Lambertian vertex.
template <class F>
Mask<F> has_left_none(const UInt<F>& gathering) {
  return equal<F>(UInt<F>(gathering & ~(any_rough | last_rough)), UInt<F>(0u));
}

/// Whether all light that the path finds counts, as without maps.
template <class F>
Mask<F> without_maps(const UInt<F>& gathering) {
  return has_left_none<F>(UInt<F>(gathering & ~path_tracing));
}

/// Whether light that the path's ray meets reaches the camera or the first Lambertian vertex directly or by mirrors and
/// glass.
template <class F>
Mask<F> is_direct(const UInt<F>& gathering) {
  return has_left_none<F>(UInt<F>(gathering & ~(left_first | not_lambertian_since)));
}

/// Whether light that the path's ray meets counts. `weighted`: light samples share it with such rays.
template <class F>
Mask<F> counts_light(const UInt<F>& gathering, bool weighted) {
  if (!weighted) return without_maps<F>(gathering);
  return without_maps<F>(gathering) || equal<F>(UInt<F>(gathering & not_lambertian_since), UInt<F>(0u));
}

/// Whether a path that meets a Lambertian surface gathers photons of both maps there and ends. `squared_distance` is
/// the squared length of its last ray.
template <class F>
Mask<F> ends(const UInt<F>& gathering, const F& squared_distance, float near_hit) {
  const Mask<F> near = equal<F>(gathering, UInt<F>(left_first)) && squared_distance < F(near_hit * near_hit);
  return !has_left_none<F>(gathering) && !near;
}

/// Beside a caustic map: whether a path that meets a Lambertian surface gathers caustic photons there.
template <class F>
Mask<F> looks_caustics_up(const UInt<F>& gathering) {
  return equal<F>(UInt<F>(gathering & (left_near | path_tracing)), UInt<F>(0u));
}

/// PathState::gathering after a Lambertian vertex.
template <class F>
UInt<F> leave_lambertian(const UInt<F>& gathering) {
  return select(has_left_none<F>(gathering), UInt<F>(left_first), UInt<F>(left_near));
}

/// The same beside a caustic map.
template <class F>
UInt<F> go_on_from_lambertian(const UInt<F>& gathering) {
  return select(looks_caustics_up<F>(gathering), leave_lambertian<F>(gathering), UInt<F>(path_tracing));
}

/// PathState::gathering after any other vertex.
template <class F>
UInt<F> leave_other(const UInt<F>& gathering) {
  return select(without_maps<F>(gathering), gathering, UInt<F>(gathering | not_lambertian_since));
}

}  // namespace photonproof::final_gather
