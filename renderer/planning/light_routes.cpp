#include "renderer/planning/light_routes.h"

#include <algorithm>

namespace photonproof::inline renderer_planning {
namespace {

bool is_delta_turn(char t) { return t == turn::is_thrown || t == turn::goes_straight; }
bool begins_with_delta(const LightRoute& route) { return !route.turns.empty() && is_delta_turn(route.turns.front()); }
bool ends_with_delta(const LightRoute& route) { return !route.turns.empty() && is_delta_turn(route.turns.back()); }

/// Camera paths meet every light that has a size. They sample the others, unless the first surface after the light
/// sends it into one direction or straight on.
bool path_finds(const LightRoute& route) { return !route.from_point || !begins_with_delta(route); }

/// The same, but it samples lights through surfaces that light goes straight through.
bool volpath_finds(const LightRoute& route) {
  LightRoute bent = route;
  std::erase(bent.turns, turn::goes_straight);
  return path_finds(bent);
}

/// Every vertex is connected to the camera, except where the camera sees it by one direction alone. Lights themselves
/// are shown by points of their own.
bool ptracer_finds(const LightRoute& route) { return !ends_with_delta(route); }

/// Both, and light paths connected to camera paths between two vertices that scatter.
bool bdpt_finds(const LightRoute& route) {
  const auto scatters = [](char t) { return !is_delta_turn(t); };
  const auto joined = std::adjacent_find(route.turns.begin(), route.turns.end(),
                                         [&](char a, char b) { return scatters(a) && scatters(b); });
  return path_finds(route) || (!route.turns.empty() && scatters(route.turns.back())) || joined != route.turns.end();
}

/// Camera paths to a surface where photons are.
bool photon_mapper_finds(const LightRoute& route) {
  return path_finds(route) || route.turns.find(turn::scatters) != std::string::npos;
}

bool direct_finds(const LightRoute& route) { return route.turns.size() <= 1 && path_finds(route); }

/// Camera paths branch at deltas alone, and sample lights at the first other surface, where they end.
bool whitted_finds(const LightRoute& route) {
  const auto first = route.turns.begin() + (route.turns.empty() || begins_with_delta(route) ? 0 : 1);
  return path_finds(route) && std::all_of(first, route.turns.end(), is_delta_turn);
}

/// Ellipsoids have colours of their own.
bool field_finds(const LightRoute&) { return false; }

constexpr std::string_view thrown =
    "light of lights without size that mirrors, glass, clear coats or holes send on (caustics)";
constexpr std::string_view thrown_on_sharp =
    "light of lights without size that mirrors, glass or clear coats send onto sharp highlights or rough glass";

constexpr LightFinder finders[] = {
    {"path", path_finds, true, true, thrown},
    {"bdpt", bdpt_finds, true, true,
     "caustics of lights without size where the camera sees them in mirrors, glass, clear coats or through holes"},
    {"photonmapper", photon_mapper_finds, true, true, thrown_on_sharp},
    {"sppm", photon_mapper_finds, true, true, thrown_on_sharp},
    {"volpath", volpath_finds, true, true,
     "light of lights without size that mirrors, glass or clear coats send on (caustics)"},
    {"ptracer", ptracer_finds, false, true,
     "light that the camera sees in mirrors, glass, clear coats or through holes"},
    {"whitted", whitted_finds, false, false, "light that surfaces throw on each other (interreflection and caustics)"},
    {"direct", direct_finds, false, false, "light that is reflected or refracted more than once"},
    {"volprim_rf_basic", field_finds, false, false,
     "light of all lights: it shows ellipsoids with colours of their own"},
};

}  // namespace

std::span<const LightFinder> light_finders() { return finders; }

}  // namespace photonproof::inline renderer_planning
