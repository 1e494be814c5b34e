// Gradient noise of the plane (Perlin 2002): the height of the water.
#pragma once

/// Smooth, about -1 to 1, 0 where x and y are whole numbers.
double noise(double x, double y, unsigned seed);
