// Fuzzes the reader of serialized meshes. Built with libFuzzer (preset fuzz), and run by serialized_test.cpp.
#include "scenes/meshes/serialized_fuzz.h"

#include <cstdio>
#include <cstdlib>

#include "scenes/meshes/serialized.h"
#include "scenes/meshes/test_mesh_promises.h"

namespace photonproof::inline scenes_meshes {

std::string check_serialized(std::string_view bytes) {
  for (const int index : {0, 1}) {
    TriangleMesh mesh;
    try {
      mesh = parse_serialized(bytes, "fuzz.serialized", index);
    } catch (const InputError& error) {
      const std::string problem = problem_with(error, "fuzz.serialized");
      if (!problem.empty()) return problem;
      continue;
    }
    const std::string problem = problem_with(mesh);
    if (!problem.empty()) return problem;
  }
  return {};
}

}  // namespace photonproof::inline scenes_meshes

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_serialized({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
#endif
