// The light that an integrator finds, by the route that the light takes. This table is the only source for the plan's
// "cannot find", the warning of a render and the `cannot_find` of its stats. Routes are in Heckbert's (1990) notation,
// from the light to the camera.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace photonproof::inline renderer_planning {

/// The ways in which light leaves a surface.
namespace turn {
constexpr char scatters = 'D';       ///< Into all directions, or rough enough for photons to be gathered.
constexpr char glitters = 'G';       ///< Around one direction: a sharp highlight, rough glass.
constexpr char is_thrown = 'S';      ///< Into one direction: mirrors, smooth glass, clear coats.
constexpr char goes_straight = 'N';  ///< Straight on, unchanged: holes of masks, null surfaces, thin panes.
}  // namespace turn

struct LightRoute {
  bool from_point = false;  ///< the light has one position or one direction: rays never meet it
  std::string turns{};      ///< from the light to the camera; empty where the camera sees the light itself
};

struct LightFinder {
  std::string_view integrator;
  /// Whether some path of the integrator may follow the route.
  bool (*finds)(const LightRoute&);
  /// Whether routes that it misses need a light without size, and a turn into one direction.
  bool needs_point, needs_delta;
  std::string_view misses;  ///< the light that it misses, a phrase
};

/// One row per integrator, in the order in which messages recommend them.
std::span<const LightFinder> light_finders();

}  // namespace photonproof::inline renderer_planning
