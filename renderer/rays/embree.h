// Embree, of the version that was found.
#pragma once

#ifdef PHOTONPROOF_EMBREE4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
