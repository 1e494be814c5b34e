// The choice of the kernels' instruction set. The program contains those of PHOTONPROOF_KERNELS (CMakeLists.txt), by
// default all; the best one of the processor is the default.
#pragma once

#include <string>
#include <vector>

#include "renderer/kernels/tasks.h"

namespace photonproof::inline renderer_kernels {

/// The kernels that this processor can run, best first. In a program with all kernels the last is "scalar", one lane,
/// which defines the others. Throws InputError if the program was built for better processors alone.
const std::vector<Kernels>& available_kernels();

/// The kernels of that name; an empty name means the best. Throws InputError listing the available ones.
const Kernels& kernels_for(const std::string& isa);

}  // namespace photonproof::inline renderer_kernels
