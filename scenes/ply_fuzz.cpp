// Fuzzes the PLY reader: any bytes either give one InputError or a mesh whose indices and numbers are sound and that
// write_ply gives back exactly. Built with libFuzzer (preset fuzz), and run over ply_corpus/ by ply_fuzz_test.cpp.
#include "scenes/ply_fuzz.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "scenes/input_error.h"
#include "scenes/ply.h"
#include "scenes/utf8.h"

namespace photonproof {
namespace {

std::string problem_with(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  if (vertices == 0 || mesh.triangles.empty()) return "an empty mesh";
  if (!mesh.is_padded()) return "no padding";
  if (!mesh.normals.empty() && mesh.normals.size() != vertices) return "normals are not one a vertex";
  if (!mesh.uvs.empty() && mesh.uvs.size() != vertices) return "texture coordinates are not one a vertex";
  const auto finite = [](const Vec3f& v) { return is_finite(v); };
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite)) return "a position is not finite";
  if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), finite)) return "a normal is not finite";
  for (const auto& uv : mesh.uvs)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a texture coordinate is not finite";
  for (const TriangleMesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= vertices) return "an index out of range";
  return {};
}

std::string problem_with_writing(const TriangleMesh& mesh) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("photonproof-ply-fuzz-" + std::to_string(getpid()) + ".ply");
  write_ply(file, mesh);
  const TriangleMesh again = read_ply(file.string());
  std::filesystem::remove(file);
  return again == mesh ? "" : "writing and reading changes the mesh";
}

}  // namespace

std::string check_ply(std::string_view bytes) {
  TriangleMesh mesh;
  try {
    mesh = parse_ply(bytes, "fuzz.ply");
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (find_invalid_utf8(what) != std::string::npos) return "a message is not valid UTF-8";
    return error.summary().rfind("fuzz.ply:", 0) != 0 || what.rfind(error.summary(), 0) != 0 ? "a bad message" : "";
  }
  const std::string problem = problem_with(mesh);
  return problem.empty() ? problem_with_writing(mesh) : problem;
}

}  // namespace photonproof

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_ply({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
