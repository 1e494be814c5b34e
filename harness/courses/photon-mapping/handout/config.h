// All parameters. The graders put their own file of this name here before they build: leave them alone.
#pragma once

#define GLOBAL_PHOTONS 1000            // of each light
#define CAUSTIC_PHOTONS 10000          // of each light, in a scene without water
#define CAUSTIC_PHOTONS_WATER 2000000  // and with water

#define GLOBAL_LOOKUP_PHOTONS 200  // at most
#define GLOBAL_LOOKUP_RADIUS 30.0
#define CAUSTIC_LOOKUP_PHOTONS 1000  // at most
#define CAUSTIC_LOOKUP_RADIUS 4.0
#define CAUSTIC_LOOKUP_RADIUS_WATER 1.1

#define GATHER_PHI 28        // rays of a final gather: around the normal,
#define GATHER_THETA 13      // and from the normal outwards
#define CACHE_TOLERANCE 1.0  // greatest error by Ward's estimate in the irradiance cache
#define CACHE_MIN_SPACING 1.0
#define CACHE_MAX_SPACING 100.0

#define SHADOW_RAYS_U 6         // along one side of the light,
#define SHADOW_RAYS_V 6         // and along the other
#define WATER_CELLS 499         // along each side, in scenes 2 and 3
#define MAX_DEPTH 6             // of mirrors and glass, from the eye
#define MAX_PHOTON_BOUNCES 100  // photons end long before
#define EPSILON 1e-4            // surfaces nearer to a ray's start are not hit
