// Fuzzes the OBJ reader. Built with libFuzzer (preset fuzz), and run over obj_corpus/ by reader_fuzz_test.cpp.
#include "scenes/meshes/obj_fuzz.h"

#include <cstdio>
#include <cstdlib>

#include "scenes/meshes/obj.h"
#include "scenes/meshes/test_mesh_promises.h"

namespace photonproof::inline scenes_meshes {

std::string check_obj(std::string_view bytes) {
  TriangleMesh mesh;
  try {
    mesh = parse_obj(bytes, "fuzz.obj");
  } catch (const InputError& error) {
    return problem_with(error, "fuzz.obj");
  }
  return problem_with(mesh);
}

}  // namespace photonproof::inline scenes_meshes

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_obj({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
#endif
