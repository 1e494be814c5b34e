// Fuzzes the reader of ellipsoids. Built with libFuzzer (preset fuzz), and run by ellipsoid_cloud_test.cpp.
#include "scenes/ellipsoids/ellipsoid_cloud_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "scenes/ellipsoids/ellipsoid_cloud.h"
#include "scenes/meshes/test_mesh_promises.h"

namespace photonproof::inline scenes_ellipsoids {
namespace {

bool is_sound(const Ellipsoid& e) {
  const double length = std::sqrt(double{e.turn[0]} * double{e.turn[0]} + double{e.turn[1]} * double{e.turn[1]} +
                                  double{e.turn[2]} * double{e.turn[2]} + double{e.turn[3]} * double{e.turn[3]});
  return is_finite(e.center) && is_finite(e.scale) && e.scale.x > 0 && e.scale.y > 0 && e.scale.z > 0 &&
         std::abs(length - 1) < 1e-5;
}

std::string problem_with(const EllipsoidCloud& cloud, std::size_t bytes) {
  const std::size_t count = cloud.ellipsoids.size();
  if (count == 0) return "no ellipsoid";
  if (count * 2 * 13 > bytes + 1) return "more ellipsoids than the file has room for";
  if (!std::ranges::all_of(cloud.ellipsoids, is_sound)) return "an ellipsoid that is not finite, or its turn no unit";
  if (!cloud.opacities.empty() && cloud.opacities.size() != count) return "another number of opacities";
  if (!std::ranges::all_of(cloud.opacities, [](float v) { return v >= 0 && v <= 1; }))
    return "an opacity beyond 0 to 1";
  if (cloud.harmonics.size() != count * cloud.coefficients) return "another number of harmonics";
  const auto is_known = [](const Rgb& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  return std::ranges::all_of(cloud.harmonics, is_known) ? "" : "a harmonic that is not finite";
}

}  // namespace

std::string check_ellipsoids(std::string_view bytes) {
  try {
    return problem_with(parse_ellipsoids(bytes, "fuzz.ply"), bytes.size());
  } catch (const InputError& error) {
    return scenes_meshes::problem_with(error, "fuzz.ply");
  }
}

}  // namespace photonproof::inline scenes_ellipsoids

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_ellipsoids({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
#endif
