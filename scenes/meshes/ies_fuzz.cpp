// Fuzzes the IES reader. Built with libFuzzer (preset fuzz), and run over ies_corpus/ by reader_fuzz_test.cpp.
#include "scenes/meshes/ies_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "scenes/meshes/ies.h"
#include "scenes/meshes/test_mesh_promises.h"

namespace photonproof::inline scenes_meshes {

std::string check_ies(std::string_view bytes) {
  IesProfile profile;
  try {
    profile = parse_ies(bytes, "fuzz.ies");
  } catch (const InputError& error) {
    return problem_with(error, "fuzz.ies");
  }
  const std::size_t rows = profile.vertical_degrees.size(), columns = profile.horizontal_degrees.size();
  if (rows < 2 || columns < 1 || profile.candela.size() != rows * columns) return "not a whole grid";
  for (const auto& angles : {profile.vertical_degrees, profile.horizontal_degrees})
    if (!std::is_sorted(angles.begin(), angles.end(), std::less_equal<>())) return "angles do not ascend";
  const auto sound = [](double v) { return v >= 0 && std::isfinite(static_cast<float>(v)); };
  return std::all_of(profile.candela.begin(), profile.candela.end(), sound) ? "" : "a bad value";
}

}  // namespace photonproof::inline scenes_meshes

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_ies({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
#endif
