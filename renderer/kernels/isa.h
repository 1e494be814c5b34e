// Which instruction set's kernels run. All are in the program; the best one the processor has is the default.
#pragma once

#include <string>
#include <vector>

#include "renderer/kernels/tasks.h"

namespace photonproof::inline renderer_kernels {

/// Those this processor can run, best first; the last is always "scalar", one lane, the definition of the others.
const std::vector<Kernels>& available_kernels();

/// The kernels of that name; an empty name asks for the best. Throws InputError naming those there are.
const Kernels& kernels_for(const std::string& isa);

}  // namespace photonproof::inline renderer_kernels
