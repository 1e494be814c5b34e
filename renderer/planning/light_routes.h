// The light that an integrator finds, by the route that the light takes. It is the one table of facts behind the plan's
// "cannot find", the warning of a render and the `cannot_find` of its stats. Routes are written as Heckbert (1990)
// writes them, from the light to the camera.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace photonproof::inline renderer_planning {

/// The ways in which light leaves what it meets.
namespace turn {
constexpr char scatters = 'D';       ///< into all directions, or rough enough for photons to be looked up
constexpr char glitters = 'G';       ///< around one direction: a sharp highlight, rough glass
constexpr char is_thrown = 'S';      ///< into one direction: mirrors, smooth glass, clear coats
constexpr char goes_straight = 'N';  ///< on as if nothing were there: holes of masks, null surfaces, thin panes
}  // namespace turn

struct LightRoute {
  bool from_point = false;  ///< the light has one position or one direction: no ray meets it
  std::string turns{};      ///< from the light to the camera; none where the camera sees the light itself
};

struct LightFinder {
  std::string_view integrator;
  /// Whether some path of the integrator may follow the route.
  bool (*finds)(const LightRoute&);
  /// Whether routes that it misses need a light without size, and a turn into one direction.
  bool needs_point, needs_delta;
  std::string_view misses;  ///< such light, a phrase
};

/// One row an integrator, in the order in which they are advised.
std::span<const LightFinder> light_finders();

}  // namespace photonproof::inline renderer_planning
