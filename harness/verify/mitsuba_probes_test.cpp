// Renders every calibration probe with Mitsuba, if it is installed: units, orientations and formulas against
// closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "harness/verify/probes.h"
#include "reference/engines/not_representable.h"
#include "reference/mitsuba/mitsuba_engine.h"
#include "reference/mitsuba/mitsuba_python.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_verify {
namespace {

class MitsubaProbes : public testing::TestWithParam<std::size_t> {};

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  std::string name = probe_rows()[info.param].what;
  for (char& c : name)
    if (c == ' ' || c == '-') c = '_';
  return name;
}

/// Probes without an equivalent in Mitsuba.
constexpr std::array kRefused{"lacquer"};

// An unbiased engine's gain is right within 0.3 % and four standard errors, as verify judges it.
TEST_P(MitsubaProbes, is_the_closed_form) {
  const auto python = find_mitsuba_python(std::filesystem::read_symlink("/proc/self/exe"));
  if (!python || mitsuba_version(*python).empty())
    GTEST_SKIP() << "Mitsuba is not installed: ./run --with-mitsuba installs it";
  const Probe& probe = probe_rows()[GetParam()];
  const ScratchFolder folder("mitsuba-probe");
  const SceneDescription scene = write_probe(probe, folder.path() / "probe.xml");
  if (std::ranges::find(kRefused, probe.what) != kRefused.end()) {
    EXPECT_THROW(export_mitsuba(scene, {}), NotRepresentable);
    return;
  }
  EnginePicture picture;
  const MitsubaExport exported =
      export_mitsuba(scene, {.width = 32, .height = 32, .samples = 2048, .threads = 1, .variant = "auto"});
  picture.rendering = render_mitsuba(exported, {.python = *python}).rendering;
  const ProbeFit fit = fit_probe(probe, picture);
  std::printf("%s: Mitsuba %.5f +- %.5f x closed form, offset %.5f\n", probe.what.c_str(), fit.gain, fit.gain_error,
              fit.offset);
  EXPECT_LT(fit.gain_error, 0.004);
  EXPECT_LT(std::abs(fit.gain - 1), 0.003 + 4 * fit.gain_error);
  EXPECT_LT(std::abs(fit.offset), 0.003 + 4 * fit.offset_error);
}

INSTANTIATE_TEST_SUITE_P(All, MitsubaProbes, testing::Range<std::size_t>(0, probe_rows().size()), name_of);

}  // namespace
}  // namespace photonproof::inline harness_verify
