// Fuzzes the reader of curve files. Built with libFuzzer (preset fuzz), and run by curve_set_test.cpp.
#include "scenes/curves/curve_set_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "scenes/curves/curve_set.h"
#include "scenes/meshes/test_mesh_promises.h"

namespace photonproof::inline scenes_curves {
namespace {

std::string problem_with(const CurveSet& set, std::size_t least, std::size_t bytes) {
  if (set.first.empty() || set.first.front() != 0) return "no curve at the first point";
  if (set.points.size() * 8 > bytes + 1) return "more points than the file has room for";
  for (std::size_t i = 0; i < set.first.size(); ++i) {
    const std::size_t end = i + 1 < set.first.size() ? set.first[i + 1] : set.points.size();
    if (end < set.first[i] + least) return "a curve of too few points";
  }
  const auto is_sound = [](const CurvePoint& point) {
    return is_finite(point.p) && point.radius >= 0 && std::isfinite(point.radius);
  };
  return std::ranges::all_of(set.points, is_sound) ? "" : "a point that is not finite, or of a negative radius";
}

}  // namespace

std::string check_curves(std::string_view bytes) {
  for (const std::size_t least : {2, 4}) {
    std::string problem;
    try {
      problem = problem_with(parse_curves(bytes, "fuzz.txt", least), least, bytes.size());
    } catch (const InputError& error) {
      problem = scenes_meshes::problem_with(error, "fuzz.txt");
    }
    if (!problem.empty()) return problem;
  }
  return "";
}

}  // namespace photonproof::inline scenes_curves

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_curves({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
#endif
