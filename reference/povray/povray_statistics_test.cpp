#include "reference/povray/povray_statistics.h"

#include <gtest/gtest.h>

namespace photonproof::inline reference_povray {
namespace {

// Cut from a +GS file of POV-Ray 3.7.0.10.
constexpr std::string_view statistics = R"(----------------------------------------------------------------------------
Parser Time
  Parse Time:       0 hours  0 minutes  1 seconds (1.250 seconds)
              using 1 thread(s) with 1.125 CPU-seconds total
  Bounding Time:    0 hours  0 minutes  0 seconds (0.000 seconds)
              using 1 thread(s) with 0.000 CPU-seconds total
----------------------------------------------------------------------------
Pixels:            67855   Samples:               0   Smpls/Pxl: 0.00
Rays:             254937   Saved:              9969   Max Level: 20/20
Shadow Ray Tests:             64923   Succeeded:                 14772
Radiosity samples calculated:              342 (0.68 %)
Radiosity sample rays shot:              12230
Number of photons shot:            9582
Surface photons stored:           12659
----------------------------------------------------------------------------
Render Time:
  Photon Time:      0 hours  0 minutes  0 seconds (0.013 seconds)
              using 4 thread(s) with 0.014 CPU-seconds total
  Radiosity Time:   0 hours  1 minutes  0 seconds (60.070 seconds)
              using 1 thread(s) with 60.066 CPU-seconds total
  Trace Time:       0 hours  0 minutes  0 seconds (0.441 seconds)
              using 1 thread(s) with 0.437 CPU-seconds total
)";

TEST(PovrayStatistics, reads_every_phase_and_count) {
  const PovrayStatistics s = parse_povray_statistics(statistics);
  EXPECT_EQ(s.phases,
            (std::map<std::string, double>{
                {"parse", 1.25}, {"bounding", 0}, {"photon", 0.013}, {"radiosity", 60.07}, {"trace", 0.441}}));
  EXPECT_EQ(s.cpu_phases,
            (std::map<std::string, double>{
                {"parse", 1.125}, {"bounding", 0}, {"photon", 0.014}, {"radiosity", 60.066}, {"trace", 0.437}}));
  EXPECT_EQ(s.counts, (std::map<std::string, double>{{"pixels", 67855},
                                                     {"rays", 254937},
                                                     {"shadow_rays", 64923},
                                                     {"radiosity_samples", 342},
                                                     {"radiosity_rays", 12230},
                                                     {"photons_shot", 9582},
                                                     {"photons_stored", 12659}}));
}

TEST(PovrayStatistics, leaves_out_what_did_not_run) {
  const PovrayStatistics s =
      parse_povray_statistics("  Photon Time:      No photons\n  Radiosity Time:   No radiosity\n");
  EXPECT_TRUE(s.phases.empty());
  EXPECT_TRUE(s.cpu_phases.empty());
  EXPECT_TRUE(s.counts.empty());
}

TEST(PovrayStatistics, finds_the_version_in_the_banner) {
  EXPECT_EQ(povray_version("Persistence of Vision(tm) Ray Tracer Version 3.7.0.10.unofficial (g++ @\n x86_64)\n"),
            "3.7.0.10.unofficial");
  EXPECT_EQ(povray_version("something else"), "");
}

TEST(PovrayStatistics, takes_the_last_progress_of_a_chunk) {
  EXPECT_DOUBLE_EQ(povray_progress("Rendered 1024 of 4096 pixels (25%)\rRendered 3072 of 4096 pixels (75%)\r").value(),
                   0.75);
  EXPECT_FALSE(povray_progress("Rendered 1024 of ").has_value()) << "cut in the middle";
  EXPECT_FALSE(povray_progress("Parsing").has_value());
}

TEST(PovrayStatistics, keeps_the_lines_that_say_what_went_wrong) {
  EXPECT_EQ(
      povray_errors("povray: cannot open the user configuration file /root/.povray/3.7/povray.conf: No such file\n"
                    "==== [Parsing...] ====\n"
                    "File 'scene.pov' line 3: Parse Error: No matching } in 'sphere'\n"
                    "Fatal error in parser: Cannot parse input.\nRender failed\n"),
      "File 'scene.pov' line 3: Parse Error: No matching } in 'sphere'; "
      "Fatal error in parser: Cannot parse input.");
}

}  // namespace
}  // namespace photonproof::inline reference_povray
