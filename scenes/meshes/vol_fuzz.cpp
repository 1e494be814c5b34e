// Fuzzes the reader of volume files. Built with libFuzzer (preset fuzz), and run by vol_test.cpp.
#include "scenes/meshes/vol_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "scenes/meshes/test_mesh_promises.h"
#include "scenes/meshes/vol.h"

namespace photonproof::inline scenes_meshes {
namespace {

std::string problem_with(const VolumeGrid& grid, std::size_t bytes, VolValues allowed) {
  if (grid.width < 1 || grid.height < 1 || grid.depth < 1) return "a grid without cells";
  if (grid.channels != 1 && grid.channels != 3) return "neither 1 nor 3 channels";
  const std::size_t count =
      std::size_t(grid.width) * std::size_t(grid.height) * std::size_t(grid.depth) * std::size_t(grid.channels);
  if (grid.values.size() != count) return "another number of values than cells";
  if (count * sizeof(float) > bytes) return "a grid larger than its file";
  const Vec3f extent = grid.high - grid.low;
  if (!(extent.x > 0 && extent.y > 0 && extent.z > 0) || !is_finite(extent)) return "a box without extent";
  if (!std::ranges::all_of(grid.values, [&](float v) {
        return (v >= 0 || (allowed == VolValues::any && std::isfinite(v))) && v <= grid.largest;
      }))
    return "a value that is negative, not finite, or above the largest";
  return std::isfinite(grid.largest) ? "" : "a value that is not finite";
}

}  // namespace

std::string check_vol(std::string_view bytes) {
  for (const VolValues allowed : {VolValues::not_negative, VolValues::any}) {
    std::string problem;
    try {
      problem = problem_with(parse_vol(bytes, "fuzz.vol", allowed), bytes.size(), allowed);
    } catch (const InputError& error) {
      problem = problem_with(error, "fuzz.vol");
    }
    if (!problem.empty()) return problem;
  }
  return "";
}

}  // namespace photonproof::inline scenes_meshes

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_vol({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
#endif
