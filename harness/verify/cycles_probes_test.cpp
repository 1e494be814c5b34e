// Renders every calibration probe with Blender's Cycles, if it is installed: units, orientations and formulas against
// closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "harness/verify/probes.h"
#include "reference/cycles/cycles_engine.h"
#include "reference/engines/not_representable.h"
#include "scenes/base/process.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_verify {
namespace {

class CyclesProbes : public testing::TestWithParam<std::size_t> {};

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  std::string name = probe_rows()[info.param].what;
  for (char& c : name)
    if (c == ' ' || c == '-') c = '_';
  return name;
}

/// Probes without an equivalent in Cycles.
constexpr std::array kRefused{"sun and sky", "lacquer", "rough plastic", "normal map", "bump map"};

// An unbiased engine's gain is right within 0.3 % and four standard errors, as verify judges it.
TEST_P(CyclesProbes, is_the_closed_form) {
  if (!run_process({"blender", "--version"}).ok())
    GTEST_SKIP() << "Blender is not installed: ./run --with-cycles installs it";
  const Probe& probe = probe_rows()[GetParam()];
  const ScratchFolder folder("cycles-probe");
  const SceneDescription scene = write_probe(probe, folder.path() / "probe.xml");
  if (std::ranges::find(kRefused, probe.what) != kRefused.end()) {
    EXPECT_THROW(export_cycles(scene, {}), NotRepresentable);
    return;
  }
  EnginePicture picture;
  picture.rendering =
      render_cycles(export_cycles(scene, {.width = 32, .height = 32, .samples = 512, .threads = 1})).rendering;
  const ProbeFit fit = fit_probe(probe, picture);
  std::printf("%s: Cycles %.5f +- %.5f x closed form, offset %.5f\n", probe.what.c_str(), fit.gain, fit.gain_error,
              fit.offset);
  EXPECT_LT(fit.gain_error, 0.004);
  EXPECT_LT(std::abs(fit.gain - 1), 0.003 + 4 * fit.gain_error);
  EXPECT_LT(std::abs(fit.offset), 0.003 + 4 * fit.offset_error);
}

INSTANTIATE_TEST_SUITE_P(All, CyclesProbes, testing::Range<std::size_t>(0, probe_rows().size()), name_of);

}  // namespace
}  // namespace photonproof::inline harness_verify
