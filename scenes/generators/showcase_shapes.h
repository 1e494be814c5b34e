// The bodies of the scenes in scenes/showcase: glassware, pots, lamps, a ring, water and sculptures. Lengths are
// metres; bodies stand on y = 0 about the y axis.
#pragma once

#include <cstdint>

#include "scenes/generators/lathe.h"

namespace photonproof::inline scenes_generators {

constexpr double kLeastDetail = 0.1, kMostDetail = 1000;

/// How fine a curved body is. A detail of d has about d times as many triangles as a detail of 1.
struct Fineness {
  explicit Fineness(double detail);
  int steps(int at_detail_1) const;               ///< at least 1
  std::uint32_t segments(int at_detail_1) const;  ///< at least 6
  double factor;                                  ///< the root of the detail
};

/// Vessels of glass: one closed surface each, which bounds a wall of 1 to 5 mm.
TriangleMesh wine_glass(const Fineness& fine);
TriangleMesh tumbler(const Fineness& fine);
TriangleMesh bottle(const Fineness& fine);
TriangleMesh vase(const Fineness& fine);
TriangleMesh bowl(const Fineness& fine);

TriangleMesh teapot(const Fineness& fine);     ///< a closed body with its lid, a spout to +x and a handle to -x
TriangleMesh table(const Fineness& fine);      ///< round, on one foot, its top at y = 0.74
TriangleMesh door_knob(const Fineness& fine);  ///< along y, from its plate
TriangleMesh candle(const Fineness& fine);
TriangleMesh flame(const Fineness& fine);
TriangleMesh lamp_shade(const Fineness& fine);  ///< an open sheet, a bell with its rim at y = 0
TriangleMesh hoops(const Fineness& fine);       ///< eight wires about the unit sphere, each its own ring
TriangleMesh pedestal(const Fineness& fine);    ///< a round column with a foot and a top at y = 0.9
TriangleMesh figure(const Fineness& fine);      ///< a pawn, 0.6 high
TriangleMesh lamp_can(const Fineness& fine);    ///< an open cone with a closed end at y = 0, opening at y = 0.35
TriangleMesh ring(const Fineness& fine);        ///< a band of radius 1, centred on the origin, 0.43 high
TriangleMesh knot(const Fineness& fine);        ///< a trefoil about the origin, radius 0.45
TriangleMesh ladder(const Fineness& fine);      ///< of a pool: two bent rails and three rungs, which lead down at +z
TriangleMesh prism();                           ///< triangular, of length 1 along x, edges of length 0.4

/// Water over [-3.05,3.05] x [-2.25,2.25], waves of a few centimetres.
TriangleMesh ripples(const Fineness& fine);
/// A curtain over [-5,5] x [-2.5,2.5] with folds along z.
TriangleMesh curtain(const Fineness& fine);

}  // namespace photonproof::inline scenes_generators
