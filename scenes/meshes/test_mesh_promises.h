// Guarantees of every reader of meshes, for the tests and fuzzers of all of them.
#pragma once

#include <string>

#include "scenes/base/input_error.h"
#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

/// Empty when indices and numbers are valid and the mesh is padded; else the problem.
std::string problem_with(const TriangleMesh& mesh);

/// Empty when the message is valid UTF-8 about `file`.
std::string problem_with(const InputError& error, const std::string& file);

}  // namespace photonproof::inline scenes_meshes
