// Ellipsoids as Embree's user geometry, their shells as triangles without a back, and the search for the ellipsoids
// that a ray enters.
#pragma once

#include "renderer/rays/cloud_entries.h"
#include "renderer/rays/embree.h"
#include "renderer/rays/trace_tables.h"

namespace photonproof::inline renderer_rays {

/// The table must outlive the geometry and not be empty.
RTCGeometry ellipsoid_geometry(RTCDevice device, const EllipsoidTable& table);

/// Makes rays pass the triangles from behind. `shells` must outlive the geometry.
void open_backs(RTCGeometry geometry, const ShellMesh& shells);

/// Takes the entries of the ray up to its end, or to the first other surface if that is nearer.
void take_entries(RTCScene scene, RTCRay ray, CloudEntries& entries);

}  // namespace photonproof::inline renderer_rays
