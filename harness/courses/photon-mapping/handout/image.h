// Writes pictures to files: values above 1 become 1, and 0 to 1 becomes 0 to 255, without a gamma.
#pragma once

#include <string>
#include <vector>

#include "vec.h"

/// Writes a PPM file if the name ends in .ppm, else a BMP file. `picture` has the top row first.
void write_image(const std::string& name, int width, int height, const std::vector<Vec3>& picture);

unsigned char to_byte(double value);
