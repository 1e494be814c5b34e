// Final gathering (Jensen 1996; 2001, chapter 8): photons of the global map are not looked up where the camera path
// first meets a Lambertian surface, but one bounce further, where the error of a gather is averaged over many paths.
//
// Classes of paths, in Heckbert's notation from the light to the eye; S is every surface that is not Lambertian, smooth
// or rough, x the first Lambertian vertex from the eye and y the next one:
//   L S* E                        rays that meet lights, and light samples where S is rough
//   L D(x) S* E                   light samples at x; with an environment also the ray that leaves x, weighted
//   L S+ D(x) S* E                the caustic map at x
//   L D(y) S* D(x) S* E           light samples at y; with an environment also one more ray, weighted
//   L S+ D(y) S* D(x) S* E        the caustic map at y
//   L (S|D)* D S* D(y) S* D(x) S* E   the global map at y
// These are all paths, each once. So between x and y neither a light that is met counts, other than at the end of the
// ray that leaves x, nor do light samples at S: both are of L S+ D(x) S* E.
// Where y is nearer to x than a gather reaches, in corners, its disc would hold x's own surroundings. There y stands
// between x and a third vertex z: the classes of y are as those of x, and those of z as those of y above:
//   L D(z) S* D(y) S* D(x) S* E and so on.
//
// Path tracing beside a caustic map goes on from y instead of looking the global map up. Its classes are
//   L S* E, L D(x) S* E           as above
//   L D(y) S* D(x) S* E           light samples at y and the rays that leave it, weighted
//   L S+ D(x) S* E, L S+ D(y) S* D(x) S* E   the caustic map at x and at y
//   L (S|D)* D(z) S* D(y) S* D(x) S* E       path tracing from z on, the next Lambertian vertex, with all that meets
// light: what it finds by rare reflections has gone through two diffuse bounces by then.
#pragma once

#include <cstdint>

#include "renderer/lanes/lane.h"

namespace photonproof::final_gather {

/// Bits of PathState::gathering: which of the Lambertian vertices the path has left, none at first, and whether
/// anything else has scattered it since.
constexpr std::uint32_t left_first = 1, left_near = 2, not_lambertian_since = 4, path_tracing = 8;
/// And until the first of them (rough_gather.h): whether a rough part has scattered the path, and was the last to.
constexpr std::uint32_t any_rough = 16, last_rough = 32;

/// Whether the path has left no Lambertian vertex.
template <class F>
Mask<F> has_left_none(const UInt<F>& gathering) {
  return equal<F>(UInt<F>(gathering & ~(any_rough | last_rough)), UInt<F>(0u));
}

/// Whether all light counts that the path finds, as without maps.
template <class F>
Mask<F> without_maps(const UInt<F>& gathering) {
  return has_left_none<F>(UInt<F>(gathering & ~path_tracing));
}

/// Whether light that the path's ray meets goes straight to the camera or to the first Lambertian vertex, but for
/// mirrors and glass.
template <class F>
Mask<F> is_direct(const UInt<F>& gathering) {
  return has_left_none<F>(UInt<F>(gathering & ~(left_first | not_lambertian_since)));
}

/// Whether light that the path's ray meets counts. `weighted`: light samples leave their share to such rays.
template <class F>
Mask<F> counts_light(const UInt<F>& gathering, bool weighted) {
  if (!weighted) return without_maps<F>(gathering);
  return without_maps<F>(gathering) || equal<F>(UInt<F>(gathering & not_lambertian_since), UInt<F>(0u));
}

/// Whether a path that meets a Lambertian surface looks photons of both maps up there and ends. `squared_distance`:
/// that its last ray went.
template <class F>
Mask<F> ends(const UInt<F>& gathering, const F& squared_distance, float near_hit) {
  const Mask<F> near = equal<F>(gathering, UInt<F>(left_first)) && squared_distance < F(near_hit * near_hit);
  return !has_left_none<F>(gathering) && !near;
}

/// Beside a caustic map: whether a path that meets a Lambertian surface looks caustic photons up there.
template <class F>
Mask<F> looks_caustics_up(const UInt<F>& gathering) {
  return equal<F>(UInt<F>(gathering & (left_near | path_tracing)), UInt<F>(0u));
}

/// After a Lambertian vertex.
template <class F>
UInt<F> leave_lambertian(const UInt<F>& gathering) {
  return select(has_left_none<F>(gathering), UInt<F>(left_first), UInt<F>(left_near));
}

/// Beside a caustic map: after a Lambertian vertex.
template <class F>
UInt<F> go_on_from_lambertian(const UInt<F>& gathering) {
  return select(looks_caustics_up<F>(gathering), leave_lambertian<F>(gathering), UInt<F>(path_tracing));
}

/// After any other.
template <class F>
UInt<F> leave_other(const UInt<F>& gathering) {
  return select(without_maps<F>(gathering), gathering, UInt<F>(gathering | not_lambertian_since));
}

}  // namespace photonproof::final_gather
