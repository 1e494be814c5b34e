// Fuzzes the PLY reader. Any bytes must give one InputError, or a valid mesh that write_ply writes back exactly. Built
// with libFuzzer (preset fuzz), and run over ply_corpus/ by ply_fuzz_test.cpp.
#include "scenes/meshes/ply_fuzz.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "scenes/base/test_fuzz.h"
#include "scenes/meshes/ply.h"
#include "scenes/meshes/test_mesh_promises.h"

namespace photonproof::inline scenes_meshes {
namespace {

std::string problem_with_writing(const TriangleMesh& mesh) {
  static const FuzzFolder folder;
  const std::filesystem::path file = folder.path() / "again.ply";
  write_ply(file, mesh);
  const TriangleMesh again = read_ply(file.string());
  return again == mesh ? "" : "writing and reading changes the mesh";
}

}  // namespace

std::string check_ply(std::string_view bytes) {
  TriangleMesh mesh;
  try {
    mesh = parse_ply(bytes, "fuzz.ply");
  } catch (const InputError& error) {
    return problem_with(error, "fuzz.ply");
  }
  const std::string problem = problem_with(mesh);
  return problem.empty() ? problem_with_writing(mesh) : problem;
}

}  // namespace photonproof::inline scenes_meshes

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_ply({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
