// Random numbers. A run takes all of them from one sequence, which --seed chooses.
#pragma once

#include "vec.h"

void seed_random(unsigned long long seed);

/// From 0 (included) to 1 (excluded).
double random_unit();

/// A direction above the surface of this normal, with density cos / pi. u and v are from [0, 1).
Vec3 cosine_direction(Vec3 normal, double u, double v);
