// Closed-form radiometry by topic. Every value is of one colour channel; lengths are in scene units.
#pragma once

#include "reference/closed_forms/closed_forms_caustics.h"
#include "reference/closed_forms/closed_forms_enclosures.h"
#include "reference/closed_forms/closed_forms_glass.h"
#include "reference/closed_forms/closed_forms_lights.h"
#include "reference/closed_forms/closed_forms_media.h"
