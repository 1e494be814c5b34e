// Pictures as files: what is above 1 becomes 1, and 0 to 1 becomes 0 to 255, without a gamma.
#pragma once

#include <string>
#include <vector>

#include "vec.h"

/// A BMP file, or a PPM file if the name ends so. `picture` has the top row first.
void write_image(const std::string& name, int width, int height, const std::vector<Vec3>& picture);

unsigned char to_byte(double value);
