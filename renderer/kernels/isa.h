// The choice of the kernels' instruction set. The program contains all; the best one of the processor is the default.
#pragma once

#include <string>
#include <vector>

#include "renderer/kernels/tasks.h"

namespace photonproof::inline renderer_kernels {

/// The kernels that this processor can run, best first; the last is always "scalar", one lane, which defines the
/// others.
const std::vector<Kernels>& available_kernels();

/// The kernels of that name; an empty name means the best. Throws InputError listing the available ones.
const Kernels& kernels_for(const std::string& isa);

}  // namespace photonproof::inline renderer_kernels
