// Curves as Embree's round curves.
#pragma once

#include "renderer/rays/embree.h"
#include "renderer/rays/trace_tables.h"

namespace photonproof::inline renderer_rays {

/// The table must outlive the geometry and not be empty. Rays pass through the surface from inside.
RTCGeometry curve_geometry(RTCDevice device, const CurveTable& table);

}  // namespace photonproof::inline renderer_rays
